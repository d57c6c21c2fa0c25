"""A person made of a few solids, standing at one end of the table and holding it."""

import math
from typing import Final

import numpy as np
import pybullet
from numpy.typing import NDArray

Point = NDArray[np.float64]
Colour = tuple[float, float, float, float]

SHIRT: Final = (0.20, 0.42, 0.62, 1.0)
TROUSERS: Final = (0.22, 0.24, 0.30, 1.0)
SKIN: Final = (0.87, 0.68, 0.55, 1.0)
HAIR: Final = (0.25, 0.18, 0.13, 1.0)

UPPER_ARM: Final = 0.30
FOREARM: Final = 0.30
HALF_SHOULDERS: Final = 0.19
HALF_GRIP: Final = 0.16
"""Lengths [m] of a person of about 1.7 m."""


class Mannequin:
    """A standing person whose hands follow the table's end.

    Parameters
    ----------
    client
        The engine to draw in.
    hands
        Where the middle between the hands is at rest [m].
    facing
        -1 if the person looks towards -x, 1 towards +x.
    floor
        Height of the floor [m].
    """

    def __init__(self, client: int, hands: Point, facing: int, floor: float) -> None:
        self._client = client
        self._hands = hands
        hip, shoulder = floor + 0.88, floor + 1.36
        middle = hands[0] - facing * 0.27
        self._shoulders = [
            np.array([middle, side * HALF_SHOULDERS, shoulder - 0.05]) for side in (-1, 1)
        ]
        centre = np.array([middle, 0.0, 0.0])
        for side in (-0.09, 0.09):
            foot = centre + [0, side, floor + 0.08]
            self._limb(foot, centre + [0, side, hip], 0.075, TROUSERS)
            self._ball(foot + [facing * 0.06, 0, -0.04], 0.06, HAIR)
        self._box(centre + [0, 0, (hip + shoulder) / 2], (0.10, 0.17, 0.27), SHIRT)
        self._ball(centre + [0, 0, shoulder + 0.20], 0.115, SKIN)
        self._ball(centre + [-facing * 0.02, 0, shoulder + 0.235], 0.115, HAIR)
        self._limb(centre + [0, 0, shoulder], centre + [0, 0, shoulder + 0.1], 0.05, SKIN)
        self._arms = [
            (
                self._capsule(UPPER_ARM, 0.045, SHIRT),
                self._capsule(FOREARM, 0.036, SKIN),
                self._ball(np.zeros(3), 0.045, SKIN),
            )
            for _ in range(2)
        ]

    def pose(self, height: float) -> None:
        """Bring the hands to a height above rest [m]; the elbows point down and out."""
        for side, shoulder, (upper, fore, fist) in zip(
            (-1, 1), self._shoulders, self._arms, strict=True
        ):
            hand = self._hands + [0.0, side * HALF_GRIP, height]
            elbow = _elbow(shoulder, hand, np.array([0.0, side * 0.5, -1.0]))
            self._place(upper, shoulder, elbow)
            self._place(fore, elbow, hand)
            self._move(fist, hand, (0.0, 0.0, 0.0, 1.0))

    def _body(self, shape: int, position: Point, orientation: tuple[float, ...]) -> int:
        body: int = pybullet.createMultiBody(
            baseVisualShapeIndex=shape,
            basePosition=position.tolist(),
            baseOrientation=orientation,
            physicsClientId=self._client,
        )
        return body

    def _ball(self, position: Point, radius: float, colour: Colour) -> int:
        shape = pybullet.createVisualShape(
            pybullet.GEOM_SPHERE, radius=radius, rgbaColor=colour, physicsClientId=self._client
        )
        return self._body(shape, position, (0, 0, 0, 1))

    def _box(self, position: Point, half: tuple[float, float, float], colour: Colour) -> int:
        shape = pybullet.createVisualShape(
            pybullet.GEOM_BOX, halfExtents=half, rgbaColor=colour, physicsClientId=self._client
        )
        return self._body(shape, position, (0, 0, 0, 1))

    def _capsule(self, length: float, radius: float, colour: Colour) -> int:
        shape = pybullet.createVisualShape(
            pybullet.GEOM_CAPSULE,
            radius=radius,
            length=length,
            rgbaColor=colour,
            physicsClientId=self._client,
        )
        return self._body(shape, np.zeros(3), (0, 0, 0, 1))

    def _limb(self, start: Point, stop: Point, radius: float, colour: Colour) -> None:
        capsule = self._capsule(float(np.linalg.norm(stop - start)), radius, colour)
        self._place(capsule, start, stop)

    def _place(self, capsule: int, start: Point, stop: Point) -> None:
        """Lay a capsule (its axis is z) from ``start`` to ``stop``."""
        x, y, z = (stop - start) / np.linalg.norm(stop - start)
        # Half-angle quaternion of the shortest turn from z to the limb's direction.
        turn = np.array([-y, x, 0.0, 1.0 + z])
        norm = np.linalg.norm(turn)
        quaternion = turn / norm if norm > 1e-9 else np.array([1.0, 0.0, 0.0, 0.0])
        self._move(capsule, (start + stop) / 2, tuple(quaternion.tolist()))

    def _move(self, body: int, position: Point, orientation: tuple[float, ...]) -> None:
        pybullet.resetBasePositionAndOrientation(
            body, position.tolist(), orientation, physicsClientId=self._client
        )


def _elbow(shoulder: Point, hand: Point, outwards: Point) -> Point:
    """Return where the elbow is, bent towards ``outwards``; a hand out of reach straightens it."""
    reach = hand - shoulder
    distance = float(np.linalg.norm(reach))
    along = (distance**2 + UPPER_ARM**2 - FOREARM**2) / (2 * distance)
    aside = math.sqrt(max(UPPER_ARM**2 - along**2, 0.0))
    direction = reach / distance
    normal = outwards - direction * float(outwards @ direction)
    elbow: Point = shoulder + along * direction + aside * normal / np.linalg.norm(normal)
    return elbow
