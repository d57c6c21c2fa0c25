"""The rigid bodies of a scene: their shapes as meshes, and where they are."""

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import groupby
from pathlib import Path
from typing import Any, Final

import numpy as np
from colift.base.errors import InputError
from colift.benchmark.rendering.scene import Scene
from colift.benchmark.rendering.solids import Colour, Mesh, box, cylinder, limb
from colift.benchmark.world.bullet import pybullet

Pose = tuple[tuple[float, ...], tuple[float, ...]]
"""Place [m] and quaternion (x, y, z, w)."""

STILL: Final[Pose] = ((0.0, 0.0, 0.0), (0.0, 0.0, 0.0, 1.0))

BASE: Final = -1
"""PyBullet's index of a body's base."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Shape:
    """A surface of one colour on a rigid body."""

    mesh: Mesh
    colour: Colour
    frame: Pose
    """Place and turn of the mesh on the body."""


@dataclass(frozen=True, kw_only=True, eq=False)
class RigidBody:
    """What moves as one: a solid of the scene, or a link of the robot."""

    name: str
    """Its name, which no other has."""
    body: int
    link: int
    """Body and link in the engine."""
    shapes: tuple[Shape, ...]


def rigid_bodies(scene: Scene) -> tuple[RigidBody, ...]:
    """Return all that is seen in a scene.

    Raises
    ------
    InputError
        If a mesh of the robot cannot be read.
    """
    found: dict[str, int] = {}

    def named(name: str) -> str:
        found[name] = found.get(name, 0) + 1
        return name if found[name] == 1 else f"{name} {found[name]}"

    own = [
        RigidBody(
            name=named(solid.name),
            body=body,
            link=BASE,
            shapes=(Shape(mesh=solid.mesh, colour=solid.colour, frame=STILL),),
        )
        for body, solid in scene.solids.shown.items()
    ]
    return (*own, *_links(scene))


def pose_of(scene: Scene, rigid: RigidBody) -> Pose:
    """Return where a body is, as the scene is posed now."""
    if rigid.link != BASE:
        place, turn = pybullet.getLinkState(
            rigid.body, rigid.link, computeForwardKinematics=1, physicsClientId=scene.client
        )[4:6]
        return place, turn
    # PyBullet gives the pose of the base's centre of mass.
    mass = pybullet.getDynamicsInfo(rigid.body, BASE, scene.client)[3:5]
    centre = pybullet.getBasePositionAndOrientation(rigid.body, scene.client)
    pose: Pose = pybullet.multiplyTransforms(*centre, *pybullet.invertTransform(*mass))
    return pose


def _links(scene: Scene) -> Iterator[RigidBody]:
    """Yield the links of the robot that are seen."""
    if scene.robot is None:
        return
    shapes = pybullet.getVisualShapeData(scene.robot, 0, scene.client)
    for link, visuals in groupby(shapes, key=lambda each: int(each[1])):
        yield RigidBody(
            name=f"robot {_link_name(scene, link)}",
            body=scene.robot,
            link=link,
            shapes=tuple(
                Shape(
                    mesh=_mesh(kind, size, Path(file.decode())), colour=colour, frame=(place, turn)
                )
                for _, _, kind, size, file, place, turn, colour in visuals
            ),
        )


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
        case pybullet.GEOM_CAPSULE:
            return limb(size[0], (size[1], size[1])).moved((0.0, 0.0, -size[0] / 2))
        case _:
            return _from_file(file, size)


def _from_file(file: Path, scale: tuple[float, float, float]) -> Mesh:
    import trimesh  # Of the extra that writes models, which alone need a robot's meshes.

    try:
        loaded: Any = trimesh.load(file, force="mesh")
    except (ValueError, ImportError, OSError) as error:
        raise InputError(f"the robot's mesh {file} cannot be read: {error}") from error
    return Mesh(
        vertices=np.array(loaded.vertices) * scale,
        normals=np.array(loaded.vertex_normals),
        triangles=np.array(loaded.faces),
    )
