"""Solids for drawing, which never collide: boxes, discs and rounded limbs.

The engine's own capsules and cylinders are coarse prisms with blurred edges; these meshes carry
exact normals.
"""

import hashlib
import math
from dataclasses import dataclass, replace
from typing import Any, Final, Self

import numpy as np
from colift.benchmark.world.bullet import pybullet
from numpy.typing import NDArray

Point = NDArray[np.float64]
Colour = tuple[float, float, float, float]

SIDES: Final = 28
"""Sides of a round mesh."""

ARC: Final = 7
"""Rings of each rounded end."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Mesh:
    """A surface of triangles."""

    vertices: Point
    """(n, 3) [m]."""
    normals: Point
    """(n, 3) unit vectors."""
    triangles: NDArray[np.int64]
    """(m, 3) indices of vertices, anticlockwise as seen from outside."""

    def moved(self, way: tuple[float, float, float]) -> Self:
        """Return the same surface elsewhere [m]."""
        return replace(self, vertices=self.vertices + way)


@dataclass(frozen=True, kw_only=True, eq=False)
class Solid:
    """A body of one colour, as it was put into an engine."""

    name: str
    mesh: Mesh
    colour: Colour
    """Red, green, blue, opacity."""


_listed: Final[dict[bytes, dict[str, list[Any]]]] = {}


def _lists(mesh: Mesh) -> dict[str, list[Any]]:
    """Return a mesh as PyBullet takes it, the same lists for equal meshes.

    PyBullet never releases the vertices that it is given: another picture must not take more
    memory.
    """
    arrays = (mesh.vertices, mesh.normals, mesh.triangles)
    key = hashlib.sha256(b"".join(array.tobytes() for array in arrays)).digest()
    if key not in _listed:
        _listed[key] = {
            "vertices": mesh.vertices.tolist(),
            "normals": mesh.normals.tolist(),
            "uvs": [[0.0, 0.0]] * len(mesh.vertices),
            "indices": mesh.triangles.ravel().tolist(),
        }
    return _listed[key]


class Solids:
    """The solids of a scene.

    Parameters
    ----------
    client
        The engine to draw in.
    """

    def __init__(self, client: int) -> None:
        self._client = client
        self.shown: dict[int, Solid] = {}
        """Each solid by its body in the engine."""

    def add(self, name: str, mesh: Mesh, colour: Colour, centre: Point | None = None) -> int:
        """Put a solid at a place [m], the origin if none is given, and return its body."""
        shape = pybullet.createVisualShape(
            pybullet.GEOM_MESH,
            **_lists(mesh),
            rgbaColor=colour,
            physicsClientId=self._client,
        )
        body: int = pybullet.createMultiBody(
            baseVisualShapeIndex=shape,
            basePosition=[0.0, 0.0, 0.0] if centre is None else centre.tolist(),
            physicsClientId=self._client,
        )
        self.shown[body] = Solid(name=name, mesh=mesh, colour=colour)
        return body

    def lay(self, body: int, start: Point, stop: Point) -> None:
        """Lay a limb from ``start`` towards ``stop`` by the shortest turn from z."""
        reach = stop - start
        length = float(np.linalg.norm(reach))
        x, y, z = reach / length if length else (0.0, 0.0, 1.0)
        # Half-angle quaternion; a limb pointing straight down is turned about x.
        turn = np.array([-y, x, 0.0, 1.0 + z])
        norm = np.linalg.norm(turn)
        self.place(body, start, turn / norm if norm > 1e-9 else np.array([1.0, 0.0, 0.0, 0.0]))

    def place(self, body: int, at: Point, turn: Point) -> None:
        """Put a body at a place [m], turned by a quaternion (x, y, z, w)."""
        pybullet.resetBasePositionAndOrientation(
            body, at.tolist(), turn.tolist(), physicsClientId=self._client
        )


def box(half: tuple[float, float, float]) -> Mesh:
    """Return a box of half lengths ``half`` [m]."""
    faces = []
    for axis in range(3):
        for sign in (-1.0, 1.0):
            normal, first, second = np.roll(np.eye(3), axis, axis=0)
            corners = [(-1, -sign), (1, -sign), (1, sign), (-1, sign)]
            square = [sign * normal + a * first + b * second for a, b in corners]
            faces.append((np.array(square) * half, np.tile(sign * normal, (4, 1))))
    corner = 4 * np.arange(6)[:, None, None]
    return Mesh(
        vertices=np.concatenate([face for face, _ in faces]),
        normals=np.concatenate([normals for _, normals in faces]),
        triangles=(corner + np.array([[0, 1, 2], [0, 2, 3]])).reshape(-1, 3),
    )


def disc(radius: float) -> Mesh:
    """Return a flat disc [m], seen from above."""
    return _revolved(np.array([[radius, 0.0, 0.0, 1.0], [0.0, 0.0, 0.0, 1.0]]), 1.0)


def cylinder(radius: float, length: float) -> Mesh:
    """Return a cylinder about z, with its middle at the origin [m]."""
    top = length / 2
    rims = [(0.0, -top, 0, -1), (radius, -top, 0, -1), (radius, -top, 1, 0)]
    rims += [(radius, top, 1, 0), (radius, top, 0, 1), (0.0, top, 0, 1)]
    return _revolved(np.array(rims), 1.0)


def limb(length: float, radii: tuple[float, float], depth: float = 1.0) -> Mesh:
    """Return a tapered rod with round ends: two balls ``length`` apart, and their tangent cone.

    Parameters
    ----------
    length
        Distance from the first ball's centre, the origin, along z to the second's [m].
    radii
        Radii of the two balls [m]; they differ by less than ``length``.
    depth
        Thickness along x as a fraction of that along y.
    """
    slope = math.asin((radii[0] - radii[1]) / length) if length else 0.0
    rings = []
    for radius, height, start, stop in (
        (radii[0], 0.0, -math.pi / 2, slope),
        (radii[1], length, slope, math.pi / 2),
    ):
        angle = np.linspace(start, stop, ARC)
        cos, sin = np.cos(angle), np.sin(angle)
        rings.append(np.stack([radius * cos, height + radius * sin, cos, sin], axis=1))
    return _revolved(np.concatenate(rings), depth)


def _revolved(rings: Point, depth: float) -> Mesh:
    """Return a surface of revolution about z; a ring is radius, height and normal (2)."""
    around = np.linspace(0.0, 2 * math.pi, SIDES, endpoint=False)
    cos, sin = np.cos(around), np.sin(around)
    radius, height, outwards, upwards = (rings[:, i, None] for i in range(4))
    level = np.zeros(SIDES)
    vertices = np.stack([depth * radius * cos, radius * sin, height + level], axis=-1)
    normals = np.stack([outwards * cos / depth, outwards * sin, upwards + level], axis=-1)
    normals /= np.linalg.norm(normals, axis=-1, keepdims=True)
    first = np.arange(len(rings) - 1)[:, None] * SIDES
    here, there = first + np.arange(SIDES), first + np.roll(np.arange(SIDES), -1)
    triangles = np.stack([here, there, there + SIDES, here, there + SIDES, here + SIDES], axis=-1)
    return Mesh(
        vertices=vertices.reshape(-1, 3),
        normals=normals.reshape(-1, 3),
        triangles=triangles.reshape(-1, 3),
    )
