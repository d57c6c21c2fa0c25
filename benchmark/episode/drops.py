"""The rules by which a table is dropped."""

import math
from typing import Any, Final

from colift.agents.rules import ArrayFunctions, N
from colift.benchmark.world.table import TABLE_LENGTH

DROP_TILT: Final = math.radians(40)
"""A table inclined by more than this [rad] slides out of the hands."""

GRIP_FORCE: Final = 20.0
"""Mean force over a control period [N] above which the partner's two hands lose the table."""

GRIP_GAP: Final = 0.03
"""Distance between the hands and the table's end [m] at which a robot's hold is lost."""

_STEEPEST: Final = TABLE_LENGTH * math.sin(DROP_TILT)


def slides_off(f: ArrayFunctions[N], difference: N) -> Any:
    """Return whether a table slides out of the hands at a height difference of its ends [m]."""
    return f.abs(difference) > _STEEPEST


def pulled_off(f: ArrayFunctions[N], pull: N, frames: int) -> Any:
    """Return whether the sum of the partner's force over a step's frames [N] is too large."""
    return f.abs(pull) > GRIP_FORCE * frames


def out_of_reach(f: ArrayFunctions[N], gap: N) -> Any:
    """Return whether the table's end is out of the partner's reach, ``gap`` above the hands [m]."""
    return f.abs(gap) > GRIP_GAP
