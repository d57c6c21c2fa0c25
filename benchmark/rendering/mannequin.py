"""A person made of a few solids, standing at one end of the table and holding it."""

import math
from dataclasses import dataclass
from typing import Final

import numpy as np
from colift.benchmark.rendering.solids import Colour, Point, Solids, limb

Place = tuple[float, float, float]

TROUSERS: Final = (0.29, 0.33, 0.41, 1.0)
SHOES: Final = (0.17, 0.17, 0.20, 1.0)
SKIN: Final = (0.93, 0.74, 0.61, 1.0)
HAIR: Final = (0.32, 0.22, 0.15, 1.0)

SHIRT: Final = None
"""Stand-in for the colour of the shirt, which differs from person to person."""

UPPER_ARM: Final = 0.29
FOREARM: Final = 0.28
HALF_SHOULDERS: Final = 0.185
HALF_GRIP: Final = 0.15
"""Lengths [m] of a person of about 1.65 m."""

SHOULDER: Final = (-0.260, 1.28)
"""Place of the shoulders: ahead of the hands at rest, and above the floor [m]."""


@dataclass(frozen=True)
class Limb:
    """A tapered rod with round ends: a part of a person that does not move."""

    start: Place
    """Centre of the first ball: ahead of the hands, left of the middle, above the floor [m]."""
    stop: Place
    radii: tuple[float, float]
    """Radii of the two balls [m]."""
    colour: Colour | None
    depth: float = 1.0
    """Thickness seen from the side as a fraction of that seen from the front."""


def _leg(side: int, facing: int) -> tuple[Limb, ...]:
    """Return a leg; one foot is a little ahead of the other."""
    ahead = 0.05 * side * facing
    knee = (-0.35 + ahead, side * 0.10, 0.49)
    ankle = (-0.41 + 2 * ahead, side * 0.11, 0.09)
    heel, toe = (ankle[0] - 0.02, ankle[1], 0.045), (ankle[0] + 0.14, side * 0.12, 0.035)
    return (
        Limb((-0.375, side * 0.08, 0.86), knee, (0.092, 0.066), TROUSERS),
        Limb(knee, ankle, (0.066, 0.048), TROUSERS),
        Limb(heel, toe, (0.046, 0.036), SHOES),
    )


def person(facing: int) -> tuple[Limb, ...]:
    """Return a person without arms, standing and bent slightly forward."""
    eyes = [(-0.140, side * 0.036, 1.515) for side in (-1, 1)]
    return (
        *_leg(-1, facing),
        *_leg(1, facing),
        Limb((-0.375, 0, 0.87), (-0.370, 0, 0.93), (0.145, 0.145), TROUSERS, 0.75),
        Limb((-0.365, 0, 0.97), (-0.265, 0, 1.23), (0.135, 0.165), SHIRT, 0.66),
        Limb((-0.255, 0, 1.30), (-0.225, 0, 1.44), (0.055, 0.050), SKIN),
        Limb((-0.205, 0, 1.47), (-0.225, 0, 1.545), (0.070, 0.092), SKIN),
        Limb((-0.130, 0, 1.50), (-0.122, 0, 1.49), (0.014, 0.016), SKIN),
        *(Limb(eye, eye, (0.011, 0.011), HAIR) for eye in eyes),
        Limb((-0.250, 0, 1.555), (-0.230, 0, 1.575), (0.096, 0.088), HAIR),
        Limb((-0.275, 0, 1.490), (-0.265, 0, 1.535), (0.062, 0.085), HAIR),
    )


class Mannequin:
    """A standing person, bent slightly forward, whose hands follow the table's end.

    Parameters
    ----------
    solids
        The solids of the scene.
    name
        Name of the person, for those of the solids.
    hands
        Middle between the hands at rest [m].
    facing
        -1 if the person looks towards -x, 1 towards +x.
    floor
        Height of the floor [m].
    shirt
        Colour of the shirt.
    """

    def __init__(
        self, solids: Solids, name: str, hands: Point, facing: int, floor: float, shirt: Colour
    ) -> None:
        self._solids = solids
        self._name = name
        self._hands = hands
        self._below = np.array([hands[0], 0.0, floor])
        self._facing = facing
        for part in person(facing):
            self._limb(part, shirt)
        ahead, up = SHOULDER
        self._shoulders = [self._point((ahead, side * HALF_SHOULDERS, up)) for side in (-1, 1)]
        self._arms = [
            (
                solids.add(f"{name} upper arm", limb(UPPER_ARM, (0.066, 0.046)), shirt),
                solids.add(f"{name} forearm", limb(FOREARM, (0.042, 0.030)), SKIN),
                solids.add(f"{name} fist", limb(0.05, (0.037, 0.033)), SKIN),
            )
            for _ in range(2)
        ]
        self.pose(0.0, 0.0)

    def pose(self, height: float, tilt: float) -> None:
        """Bring the hands to a height above rest [m], turned with the table's tilt [rad]."""
        forwards = self._facing * np.array([math.cos(tilt), 0.0, -math.sin(tilt)])
        for side, shoulder, (upper, fore, fist) in zip(
            (-1, 1), self._shoulders, self._arms, strict=True
        ):
            hand = self._hands + [0.0, self._facing * side * HALF_GRIP, height]
            elbow, wrist = arm(shoulder, hand, forwards, self._facing * side)
            self._solids.lay(upper, shoulder, elbow)
            self._solids.lay(fore, elbow, wrist)
            self._solids.lay(fist, wrist, hand)

    def _point(self, place: Place) -> Point:
        """Return the world's point of a place (ahead of the hands, left of middle, above floor)."""
        ahead, left, up = place
        point: Point = self._below + [self._facing * ahead, self._facing * left, up]
        return point

    def _limb(self, part: Limb, shirt: Colour) -> None:
        first, last = self._point(part.start), self._point(part.stop)
        length = float(np.linalg.norm(last - first))
        mesh = limb(length, part.radii, part.depth)
        body = self._solids.add(f"{self._name} body", mesh, part.colour or shirt)
        self._solids.lay(body, first, last)


def arm(shoulder: Point, hand: Point, forwards: Point, side: int) -> tuple[Point, Point]:
    """Return the points of elbow and wrist [m]; a hand out of reach straightens the arm.

    Parameters
    ----------
    shoulder, hand
        Their points [m].
    forwards
        Unit vector in which the hands point.
    side
        The arm's side of the person's middle: -1 or 1 along y. The elbow points down, back and
        outwards to that side.
    """
    wrist = hand - 0.04 * forwards
    outwards = np.array([-0.3 * math.copysign(1.0, forwards[0]), 0.4 * side, -1.0])
    return _elbow(shoulder, wrist, outwards), wrist


def _elbow(shoulder: Point, hand: Point, outwards: Point) -> Point:
    """Return the elbow's point, bent to ``outwards``; a hand out of reach straightens the arm."""
    reach = hand - shoulder
    distance = float(np.linalg.norm(reach))
    along = (distance**2 + UPPER_ARM**2 - FOREARM**2) / (2 * distance)
    aside = math.sqrt(max(UPPER_ARM**2 - along**2, 0.0))
    direction = reach / distance
    normal = outwards - direction * float(outwards @ direction)
    elbow: Point = shoulder + along * direction + aside * normal / np.linalg.norm(normal)
    return elbow
