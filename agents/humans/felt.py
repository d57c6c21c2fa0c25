"""The force that a person's hands feel, and what it tells."""

import math
from typing import Final

from colift.agents.agent import HumanObservation, Observation

FELT_FRAMES: Final = 5
"""Newest frames of the felt force that are averaged."""

SUPPORT: Final = 0.35 * 9.81 / 2
"""Half of the table's weight [N], which hands feel when nothing else pulls."""

FELT_HEIGHT: Final = 0.8**2 / 10.0
"""Height difference of the table's ends that a force of 1 N makes at rest [m/N]: the square of the
table's length over the pitch stiffness of the other person's grip."""


def felt_force(view: Observation) -> float:
    """Return the mean force [N] of the hands beyond half of the table's weight.

    ``view`` is a :class:`.HumanObservation`: the force is one haptic delay old.
    """
    newest = view[HumanObservation.HAND_FORCE][-FELT_FRAMES:].tolist()
    return math.fsum(newest) / len(newest) - SUPPORT
