"""A ball that rolls along the table."""

import math
from dataclasses import dataclass
from typing import Final, NamedTuple

from colift.benchmark.world.table import GRAVITY, TABLE_LENGTH

ROLLING: Final = 5 / 7
"""Share of the downhill pull that accelerates a solid sphere rolling without slipping; the rest
spins it."""


class TableMotion(NamedTuple):
    """The motion of the table during one physics step."""

    pitch: float
    """p at the middle of the step [rad], positive with the far end up."""
    pitch_rate: float
    """p' [rad/s]."""
    turn: float
    """Change of p over the step [rad]."""
    rise: float
    """a, upward acceleration of the hinge at the human's hands [m/s2]."""
    push: float
    """b, its horizontal acceleration away from the far end [m/s2]."""


@dataclass(frozen=True, kw_only=True)
class Ball:
    """A solid sphere that rolls without slipping in a groove along the table.

    Its place s [m] is measured along the table from the middle, towards the far end, and r = L / 2
    + s from the hinge at the human's hands. With the speed w of its centre along the table, its
    Lagrangian

        T - V = m (7/5 w^2 + r^2 p'^2) / 2 - m g r sin(p),    w = r' - e p',

    with the radius e, on a table of the pitch p whose hinge accelerates upwards by a and backwards
    by b, gives

        w' = 5/7 (r p'^2 - (g + a) sin(p + s / R) + b cos(p)) - c r',    r' = w + e p',

    with the radius of curvature R of the centre's path along the groove, and the rolling friction
    c. The table carries its weight, m g cos(p), at s. The effect of the ball's inertia on the
    table, 3 % of its weight at a lift's acceleration of 0.3 m/s2, is neglected.
    """

    mass: float = 0.17
    """m [kg], that of a billiard ball (World Pool-Billiard Association: 156 to 170 g)."""
    radius: float = 0.0286
    """e [m], that of the same ball: 57.15 mm across."""
    friction: float = 0.15
    """c [1/s], an assumption: a ball on felt loses half of its speed in five seconds."""
    curvature: float = 0.0
    """1 / R [1/m]; 0 is flat, positive a bowl."""

    def rolled(
        self, place: float, speed: float, table: TableMotion, step: float
    ) -> tuple[float, float]:
        """Return s [m] and w [m/s] a physics step later.

        The leapfrog method moves the ball for half of the step, then accelerates it, then moves it
        for the other half. It is of second order and conserves energy on average.

        Parameters
        ----------
        place, speed
            s and w [m, m/s] before the step.
        table
            The motion of the table during the step.
        step
            Its duration [s].
        """
        shift = self.radius * table.turn
        middle = place + (step * speed + shift) / 2
        downhill = (GRAVITY + table.rise) * math.sin(table.pitch + middle * self.curvature)
        outwards = (TABLE_LENGTH / 2 + middle) * table.pitch_rate * table.pitch_rate
        pull = ROLLING * (outwards - downhill + table.push * math.cos(table.pitch))
        drag = step * self.friction / 2
        pull -= self.friction * self.radius * table.pitch_rate
        later = (speed * (1 - drag) + step * pull) / (1 + drag)
        return middle + (step * later + shift) / 2, later

    def load(self, pitch: float) -> float:
        """Return the force of the ball on the table at a pitch [rad], m g cos(p) [N]."""
        return self.mass * GRAVITY * math.cos(pitch)
