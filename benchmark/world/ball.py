"""A ball that rolls along the table."""

import math
from dataclasses import dataclass
from typing import Final

from .table import GRAVITY, TABLE_LENGTH

ROLLING: Final = 5 / 7
"""Share of the downhill pull that accelerates a solid sphere which rolls without slipping; the rest
spins it."""


@dataclass(frozen=True, kw_only=True)
class Ball:
    """The parameters of a ball in a groove along the table.

    Its place s [m] is measured along the table from the middle, towards the far end. On a table of
    the pitch p, whose hinge at the human's hands accelerates upwards by a,

        s'' = 5/7 (-(g + a) sin(p + s / R) + (L / 2 + s) p'^2) - c s',

    with the groove's radius of curvature R and the rolling friction c. The table carries its weight
    ``m g cos(p)`` at s; the inertia of a ball this light moves neither table nor hands.
    """

    mass: float = 0.17
    """m [kg], a billiard ball's (World Pool-Billiard Association: 156 to 170 g)."""
    friction: float = 0.15
    """c [1/s], an assumption: a ball on felt loses half of its speed in five seconds."""
    curvature: float = 0.0
    """1 / R of the groove [1/m]; 0 is flat, positive a bowl."""

    def acceleration(
        self, place: float, speed: float, pitch: float, pitch_rate: float, hinge: float
    ) -> float:
        """Return s'' [m/s2].

        Parameters
        ----------
        place, speed
            s and s' [m, m/s].
        pitch, pitch_rate
            p and p' [rad, rad/s].
        hinge
            a, the upward acceleration of the human's hands [m/s2].
        """
        downhill = (GRAVITY + hinge) * math.sin(pitch + place * self.curvature)
        outwards = (TABLE_LENGTH / 2 + place) * pitch_rate * pitch_rate
        return ROLLING * (outwards - downhill) - self.friction * speed

    def rolled(
        self, place: float, speed: float, acceleration: float, step: float
    ) -> tuple[float, float]:
        """Return s and s' a physics step [s] later, by the semi-implicit Euler method."""
        speed += step * acceleration
        return place + step * speed, speed
