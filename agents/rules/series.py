"""Series of numbers, one for each frame, that a rule reads at a time."""

from collections.abc import Sequence
from typing import Any, Protocol, Self

import numpy as np
from colift.agents.rules.functions import ArrayFunctions, N, N_co
from numpy.typing import NDArray


class Series(Protocol[N_co]):
    """Numbers at the ends of frames: before the first it is 0, after the last it stays."""

    def pair(self, index: Any, /) -> tuple[N_co, N_co]:
        """Return the numbers of a frame, -1 or later, and of the next; 0 is the first."""

    def at(self, frame: Any, /) -> N_co:
        """Return the number of a frame."""

    def next(self, frame: Any, frames: int, /) -> Any:
        """Return the column of the numbers of some frames, of which ``frame`` is the first."""

    @property
    def last(self) -> int:
        """Index of the last frame."""


class NumberSeries:
    """The series of one lift."""

    def __init__(self, values: Sequence[float]) -> None:
        self._values = [0.0, *values, values[-1]]

    @classmethod
    def of(cls, values: NDArray[np.float64]) -> Self:
        """Return the series of an array (n,)."""
        return cls(values.tolist())

    def pair(self, index: float, /) -> tuple[float, float]:
        """Return the numbers of a frame, -1 or later, and of the next."""
        place = int(index) + 1
        return self._values[place], self._values[place + 1]

    def at(self, frame: int, /) -> float:
        """Return the number of a frame."""
        return self._values[min(max(frame + 1, 0), len(self._values) - 1)]

    def next(self, frame: int, frames: int, /) -> list[float]:
        """Return the numbers of some frames, of which ``frame``, 0 or later, is the first."""
        found = self._values[frame + 1 : frame + 1 + frames]
        return found + [self._values[-1]] * (frames - len(found))

    @property
    def last(self) -> int:
        """Index of the last frame."""
        return len(self._values) - 3


def at_time(f: ArrayFunctions[N], series: Series[N], time: N) -> N:
    """Return the interpolated number of a series at a time in frames.

    Before the end of its first frame it goes up from 0; after its last frame it stays.
    """
    place = f.clip(time - 1.0, -1.0, float(series.last))
    index = f.floor(place)
    before, after = series.pair(index)
    return before + (place - index) * (after - before)
