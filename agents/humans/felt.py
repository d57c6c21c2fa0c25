"""The force that a person's hands feel."""

import math
from typing import Final

from colift.agents.agent import HumanObservation, Observation
from colift.agents.tasks.touch.touched import SUPPORT

FELT_FRAMES: Final = 5
"""Newest frames of the felt force that are averaged."""


def felt_force(view: Observation) -> float:
    """Return the mean force [N] of the hands beyond half of the table's weight.

    ``view`` is a :class:`.HumanObservation`: the force is one haptic delay old.
    """
    newest = view[HumanObservation.HAND_FORCE][-FELT_FRAMES:].tolist()
    return math.fsum(newest) / len(newest) - SUPPORT
