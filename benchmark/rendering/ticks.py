"""Round numbers for axes, and the values that an axis leaves off its scale."""

import math
from collections.abc import Sequence
from typing import Final

import numpy as np

FAR: Final = 3.0
"""Multiple of the median above which values are off the scale: they would squeeze the others."""

STEPS: Final = (1.0, 2.0, 5.0, 10.0)
"""Distances between ticks, up to a power of ten."""


def far_limit(values: Sequence[float]) -> float:
    """Return the greatest value that an axis has to cover; 0 without values."""
    return FAR * float(np.median(values)) if values else 0.0


def round_step(breadth: float, most: int) -> float:
    """Return the least round step that covers a breadth with at most ``most`` steps."""
    power = 10.0 ** math.floor(math.log10(breadth / most))
    return next(power * step for step in STEPS if power * step * most >= breadth)


def round_ticks(low: float, high: float, most: int) -> tuple[float, ...]:
    """Return the multiples of a round step between two ends, at most ``most + 1``."""
    step = round_step(high - low, most)
    first, last = math.ceil(low / step - 1e-9), math.floor(high / step + 1e-9)
    return tuple(round(step * i, 9) for i in range(first, last + 1))
