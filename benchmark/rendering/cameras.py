"""The cameras of a scene: from the side, from the front, from above."""

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Final

from colift.base.errors import InputError
from colift.base.near_names import did_you_mean
from colift.benchmark.world.bullet import pybullet

Place = tuple[float, float, float]


@dataclass(frozen=True, kw_only=True)
class Camera:
    """A place to look from. Lengths are in m, x from the robot to the human, z upwards."""

    eye: Place
    """Its place, from the middle of the scene at the height of the table at rest."""
    aim: Place
    """The point in the middle of the picture, likewise."""
    up: Place
    """The direction that points upwards in the picture."""
    half_height: float
    """Half of the height that it has to show at that point, so that everybody is seen whole."""
    half_width: float | None
    """Half of the width; None for the width of the scene."""

    def matrices(
        self, middle: float, half_width: float, size: tuple[int, int]
    ) -> tuple[tuple[float, ...], tuple[float, ...]]:
        """Return the matrices of view and projection, as PyBullet takes them.

        Parameters
        ----------
        middle, half_width
            x of the scene's middle, and half of its width [m].
        size
            Width and height of the picture [pixels].
        """
        eye, aim = ((middle + x, y, z) for x, y, z in (self.eye, self.aim))
        width, height = size
        wide = half_width if self.half_width is None else self.half_width
        half = max(self.half_height, wide * height / width) / math.dist(eye, aim)
        view = pybullet.computeViewMatrix(eye, aim, self.up)
        degrees = 2 * math.degrees(math.atan(half))
        return view, pybullet.computeProjectionMatrixFOV(degrees, width / height, 0.1, 6.0)


SIDE: Final = "side"
"""The camera that shows best whether the table is level."""

CLOSE: Final = "close"
"""The same, nearer: for small pictures, without the legs."""

CAMERAS: Final[Mapping[str, Camera]] = {
    SIDE: Camera(
        eye=(0.18, -2.55, 0.42),
        aim=(0.0, 0.0, 0.0),
        up=(0.0, 0.0, 1.0),
        half_height=0.93,
        half_width=None,
    ),
    CLOSE: Camera(
        eye=(0.18, -2.55, 0.48),
        aim=(0.0, 0.0, 0.16),
        up=(0.0, 0.0, 1.0),
        half_height=0.72,
        half_width=0.98,
    ),
    "front": Camera(
        eye=(-2.9, -2.0, 1.15),
        aim=(-0.08, 0.0, -0.13),
        up=(0.0, 0.0, 1.0),
        half_height=1.08,
        half_width=0.85,
    ),
    "top": Camera(
        eye=(0.0, 0.0, 2.8),
        aim=(0.0, 0.0, 0.0),
        up=(0.0, 1.0, 0.0),
        half_height=0.45,
        half_width=None,
    ),
}
"""Cameras by name. The front is that of the human: the view is from behind the robot."""


def check_camera(name: str) -> None:
    """Refuse an unknown camera.

    Raises
    ------
    InputError
        If there is none of that name; the message lists all.
    """
    if name not in CAMERAS:
        near = did_you_mean(name, CAMERAS)
        raise InputError(f"unknown camera {name!r}; {near}known: {', '.join(CAMERAS)}")
