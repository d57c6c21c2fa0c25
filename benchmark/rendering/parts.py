"""The parts of a scene as meshes, and where they are."""

from dataclasses import dataclass
from pathlib import Path
from typing import Any, Final

import numpy as np
from colift.benchmark.rendering.scene import Scene
from colift.benchmark.rendering.solids import Colour, Mesh, box, cylinder, limb
from colift.benchmark.world.bullet import pybullet

Pose = tuple[tuple[float, ...], tuple[float, ...]]
"""Place [m] and quaternion (x, y, z, w)."""

BASE: Final = -1
"""PyBullet's index of a body's base."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Part:
    """A rigid part of a scene, of one colour."""

    name: str
    """Its name, which no other part has."""
    body: int
    link: int
    """Body and link in the engine."""
    frame: Pose
    """Place and turn of the mesh in the frame of its link."""
    mesh: Mesh
    colour: Colour


def parts_of(scene: Scene) -> tuple[Part, ...]:
    """Return all parts of a scene."""
    found: dict[str, int] = {}

    def named(name: str) -> str:
        found[name] = found.get(name, 0) + 1
        return name if found[name] == 1 else f"{name} {found[name]}"

    still = (0.0, 0.0, 0.0), (0.0, 0.0, 0.0, 1.0)
    own = [
        Part(
            name=named(solid.name),
            body=body,
            link=BASE,
            frame=still,
            mesh=solid.mesh,
            colour=solid.colour,
        )
        for body, solid in scene.solids.shown.items()
    ]
    shapes = (
        () if scene.robot is None else pybullet.getVisualShapeData(scene.robot, 0, scene.client)
    )
    robot = [
        Part(
            name=named(f"robot {_link_name(scene, link)}"),
            body=body,
            link=link,
            frame=(place, turn),
            mesh=_mesh(kind, size, Path(file.decode())),
            colour=colour,
        )
        for body, link, kind, size, file, place, turn, colour in shapes
    ]
    return (*own, *robot)


def poses_of(scene: Scene, parts: tuple[Part, ...]) -> list[Pose]:
    """Return the pose of each part as the scene is now."""
    return [_pose(scene.client, part) for part in parts]


def _pose(client: int, part: Part) -> Pose:
    if part.link == BASE:
        # PyBullet gives the pose of the base's centre of mass.
        mass = pybullet.getDynamicsInfo(part.body, BASE, client)[3:5]
        centre = pybullet.getBasePositionAndOrientation(part.body, client)
        place, turn = pybullet.multiplyTransforms(*centre, *pybullet.invertTransform(*mass))
    else:
        place, turn = pybullet.getLinkState(
            part.body, part.link, computeForwardKinematics=1, physicsClientId=client
        )[4:6]
    pose: Pose = pybullet.multiplyTransforms(place, turn, *part.frame)
    return pose


def _link_name(scene: Scene, link: int) -> str:
    if link == BASE:
        return "base"
    name: bytes = pybullet.getJointInfo(scene.robot, link, scene.client)[12]
    return name.decode()


def _mesh(kind: int, size: tuple[float, float, float], file: Path) -> Mesh:
    """Return a visual shape of PyBullet as a mesh."""
    match kind:
        case pybullet.GEOM_SPHERE:
            return limb(0.0, (size[0], size[0]))
        case pybullet.GEOM_BOX:
            return box((size[0] / 2, size[1] / 2, size[2] / 2))
        case pybullet.GEOM_CYLINDER:
            return cylinder(size[1], size[0])
        case _:
            return _from_file(file, size)


def _from_file(file: Path, scale: tuple[float, float, float]) -> Mesh:
    import trimesh  # Of the extra that writes models, the only one that needs a robot's meshes.

    loaded: Any = trimesh.load(file, force="mesh")
    return Mesh(
        vertices=np.array(loaded.vertices) * scale,
        normals=np.array(loaded.vertex_normals),
        triangles=np.array(loaded.faces),
    )
