"""The table and the ball, as both partners know them."""

from typing import Final

from colift.agents.rules import N

LENGTH: Final = 0.8
"""Distance between the table's ends [m]."""

HALF_WEIGHT: Final = 0.35 * 9.81 / 2
"""Force that carries half of the table [N]."""

BALL_WEIGHT: Final = 0.17 * 9.81
"""Weight of the ball [N]."""

PULL: Final = 5 / 7 * 9.81 / LENGTH
"""Acceleration of the ball per height difference of the ends [m/s2 per m]."""

WRIST: Final = 10.0
"""Pitch stiffness of a person's grip [Nm/rad]."""


def meant_by_wrists(force: N, difference: N, place: N) -> N:
    """Return the height difference of the ends [m] that the near person's wrists turn to.

    By the balance of torques about the near hands, without the table's inertia:

        L (p_w - p) = ((1/2 + s / L) m g - F) L^2 / K.

    Parameters
    ----------
    force
        F, the force of the far hands beyond half of the table's weight [N].
    difference
        The height difference of the ends, far above near [m].
    place
        s, the ball's place [m].
    """
    beyond = force - (0.5 + place / LENGTH) * BALL_WEIGHT
    return difference - beyond * LENGTH**2 / WRIST
