"""Welding joints: bodies that no longer move against each other become one."""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, replace

import numpy as np
from colift.robots.arithmetic import dot, matmul
from colift.robots.description import rotations
from colift.robots.description.parts import Inertia, Joint, Link, Shape, Vector
from numpy.typing import NDArray

Array = NDArray[np.float64]


@dataclass(frozen=True, kw_only=True)
class _Mount:
    """Pose of a link on the body to which it is welded."""

    host: str
    position: Array
    rotation: Array

    def point(self, at: Vector) -> Array:
        """Return a point of the link in the host's frame."""
        moved: Array = self.position + dot(self.rotation, np.array(at))
        return moved

    def rpy(self, rpy: Vector) -> Vector:
        """Return an orientation in the link's frame as one in the host's."""
        return rotations.to_rpy(matmul(self.rotation, rotations.from_rpy(rpy)))

    def shapes(self, shapes: Iterable[Shape]) -> tuple[Shape, ...]:
        """Return shapes of the link as the host's."""
        return tuple(
            replace(shape, at=_vector(self.point(shape.at)), rpy=self.rpy(shape.rpy))
            for shape in shapes
        )


def weld(
    joints: Iterable[Joint], links: Iterable[Link], angles: Mapping[str, float]
) -> tuple[list[Joint], list[Link]]:
    """Return the robot with some joints welded.

    Parameters
    ----------
    joints, links
        The robot; joints come after the joint of their parent.
    angles
        Angle [rad] of each joint to weld, by name.

    Returns
    -------
    tuple
        The joints that still move, and the bodies that they join: with the mass, centre of mass,
        inertia (parallel-axis theorem) and shapes of all that is welded to them.
    """
    bodies = {link.name: link for link in links}
    mounts = {name: _Mount(host=name, position=np.zeros(3), rotation=np.eye(3)) for name in bodies}
    moving = []
    for joint in joints:
        parent = mounts[joint.parent]
        origin = parent.point(joint.origin)
        if joint.name in angles:
            turn = rotations.about(joint.axis, angles[joint.name])
            mounts[joint.child] = _Mount(
                host=parent.host,
                position=origin,
                rotation=matmul(matmul(parent.rotation, rotations.from_rpy(joint.rpy)), turn),
            )
        else:
            rpy = parent.rpy(joint.rpy)
            moving.append(replace(joint, parent=parent.host, origin=_vector(origin), rpy=rpy))
    hosts = [name for name, mount in mounts.items() if mount.host == name]
    return moving, [
        _one_body(host, [(bodies[name], m) for name, m in mounts.items() if m.host == host])
        for host in hosts
    ]


def _one_body(name: str, parts: list[tuple[Link, _Mount]]) -> Link:
    mass = sum(link.mass for link, _ in parts)
    com = sum((link.mass * mount.point(link.com) for link, mount in parts), np.zeros(3)) / mass
    inertia = np.zeros((3, 3))
    for link, mount in parts:
        offset = mount.point(link.com) - com
        inertia += matmul(matmul(mount.rotation, _matrix(link.inertia)), mount.rotation.T)
        inertia += link.mass * (dot(offset, offset) * np.eye(3) - offset[:, np.newaxis] * offset)
    xx, xy, xz, yy, yz, zz = (float(inertia[i, j]) for i in range(3) for j in range(i, 3))
    return Link(
        name=name,
        mass=mass,
        com=_vector(com),
        inertia=(xx, xy, xz, yy, yz, zz),
        visuals=tuple(s for link, mount in parts for s in mount.shapes(link.visuals)),
        collisions=tuple(s for link, mount in parts for s in mount.shapes(link.collisions)),
    )


def _matrix(inertia: Inertia) -> Array:
    xx, xy, xz, yy, yz, zz = inertia
    return np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])


def _vector(point: Array) -> Vector:
    x, y, z = point.tolist()
    return x, y, z
