"""Solids for drawing, which never collide: boxes, discs and rounded limbs.

The engine's own capsules and cylinders are coarse prisms with blurred edges; these meshes carry
exact normals.
"""

import math
from typing import Final

import numpy as np
from colift.benchmark.world.bullet import pybullet
from numpy.typing import NDArray

Point = NDArray[np.float64]
Colour = tuple[float, float, float, float]

SIDES: Final = 28
"""Sides of a round mesh."""

ARC: Final = 7
"""Rings of each rounded end."""


def box(client: int, centre: Point, half: tuple[float, float, float], colour: Colour) -> int:
    """Return a box of half lengths ``half`` [m]."""
    shape = pybullet.createVisualShape(
        pybullet.GEOM_BOX, halfExtents=half, rgbaColor=colour, physicsClientId=client
    )
    return _body(client, shape, centre)


def disc(client: int, centre: Point, radius: float, colour: Colour) -> int:
    """Return a flat disc [m], seen from above."""
    rings = np.array([[radius, 0.0, 0.0, 1.0], [0.0, 0.0, 0.0, 1.0]])
    return _body(client, _revolved(client, rings, 1.0, colour), centre)


def limb(
    client: int, length: float, radii: tuple[float, float], colour: Colour, depth: float = 1.0
) -> int:
    """Return a tapered rod with round ends: two balls ``length`` apart, and their tangent cone.

    Parameters
    ----------
    client
        The engine to draw in.
    length
        Distance from the first ball's centre, the origin, along z to the second's [m].
    radii
        Radii of the two balls [m]; they differ by less than ``length``.
    colour
        Red, green, blue, opacity.
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
    return _body(client, _revolved(client, np.concatenate(rings), depth, colour), np.zeros(3))


def lay(client: int, body: int, start: Point, stop: Point) -> None:
    """Lay a limb from ``start`` towards ``stop`` by the shortest turn from z."""
    reach = stop - start
    length = float(np.linalg.norm(reach))
    x, y, z = reach / length if length else (0.0, 0.0, 1.0)
    # Half-angle quaternion; a limb pointing straight down is turned about x.
    turn = np.array([-y, x, 0.0, 1.0 + z])
    norm = np.linalg.norm(turn)
    quaternion = turn / norm if norm > 1e-9 else np.array([1.0, 0.0, 0.0, 0.0])
    pybullet.resetBasePositionAndOrientation(
        body, start.tolist(), quaternion.tolist(), physicsClientId=client
    )


def _revolved(client: int, rings: Point, depth: float, colour: Colour) -> int:
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
    shape: int = pybullet.createVisualShape(
        pybullet.GEOM_MESH,
        vertices=vertices.reshape(-1, 3).tolist(),
        normals=normals.reshape(-1, 3).tolist(),
        uvs=[[0.0, 0.0]] * (len(rings) * SIDES),
        indices=triangles.ravel().tolist(),
        rgbaColor=colour,
        physicsClientId=client,
    )
    return shape


def _body(client: int, shape: int, position: Point) -> int:
    body: int = pybullet.createMultiBody(
        baseVisualShapeIndex=shape, basePosition=position.tolist(), physicsClientId=client
    )
    return body
