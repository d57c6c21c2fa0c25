"""Heights of the table's ends from marker positions, with detection of hidden and frozen markers.

The height of an end is the mean over its markers, as in the paper (section II.A). An end is not
seen if one of its markers is hidden (NaN) or frozen. Some clients repeat the last position of a
lost marker; a held table never rests so still that a camera measures the same height repeatedly.
"""

import math
from collections.abc import Sequence
from typing import Final, NamedTuple

from colift.agents.hardware.ports import Sample

FROZEN_FRAMES: Final = 10
"""Consecutive frames with bit-identical height after which a marker counts as frozen.

Heights have a noise of 0.2 to 0.3 mm. As 32-bit floats, two consecutive ones are equal with a
probability of 1e-4; rounded to 0.1 mm, ten consecutive ones of a marker at rest with less than
1e-6. A false alarm holds the hands for one period."""

FROZEN_TIME: Final = 0.1
"""Shortest time spanned by these frames [s]: a client may send each camera frame several times.
At 100 Hz both limits coincide; at the lowest rate, 50 Hz, ten frames take 0.2 s."""


class Height(NamedTuple):
    """Location of a marker's height in a row."""

    marker: str
    channel: int
    scale: float
    """Metres per unit."""


class _Repeated:
    """Number and duration of a marker's equal heights."""

    def __init__(self) -> None:
        self._value, self._since, self._count = math.nan, 0.0, 0

    def frozen(self, time: float, value: float) -> bool:
        """Add the height at a time; return whether it has been the same for too long."""
        if value != self._value:
            self._value, self._since, self._count = value, time, 0
        self._count += 1
        return self._count >= FROZEN_FRAMES and time - self._since >= FROZEN_TIME


class MarkerEnds:
    """Conversion of rows of marker positions into samples of the table's ends.

    Parameters
    ----------
    human, robot
        The markers of each end.
    rest
        Height of both ends at rest [m].
    """

    def __init__(self, human: Sequence[Height], robot: Sequence[Height], rest: float = 0.0) -> None:
        self._human, self._robot = tuple(human), tuple(robot)
        self._human_rest = self._robot_rest = rest
        self._repeated = {height.marker: _Repeated() for height in (*human, *robot)}
        self._hidden: list[str] = []
        self._frozen: list[str] = []

    def set_rest(self, human_end: float, robot_end: float) -> None:
        """Subtract these heights [m] from the ends' heights."""
        self._human_rest += human_end
        self._robot_rest += robot_end

    def sample(self, time: float, row: Sequence[float]) -> Sample:
        """Return the ends' heights in the next row, captured at a time [s]."""
        self._hidden, self._frozen = [], []
        return Sample(
            time,
            self._height(time, row, self._human) - self._human_rest,
            self._height(time, row, self._robot) - self._robot_rest,
        )

    def _height(self, time: float, row: Sequence[float], markers: Sequence[Height]) -> float:
        """Return the mean height of some markers [m]; NaN if one is hidden or frozen."""
        total = 0.0
        for marker, channel, scale in markers:
            value = row[channel] * scale
            if not math.isfinite(value):
                self._hidden.append(marker)
            elif self._repeated[marker].frozen(time, value):
                self._frozen.append(marker)
            total += value
        unseen = any(height.marker in (*self._hidden, *self._frozen) for height in markers)
        return math.nan if unseen else total / len(markers)

    @property
    def unseen(self) -> str:
        """Markers not seen in the last row, with the reason; empty if all were seen."""
        parts = []
        if self._hidden:
            parts.append(f"{', '.join(self._hidden)} hidden")
        if self._frozen:
            parts.append(
                f"{', '.join(self._frozen)} frozen: the same height to the bit in "
                f"{FROZEN_FRAMES} frames or more"
            )
        return "; ".join(parts)
