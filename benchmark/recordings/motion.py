"""Motion as a file holds it: the points that were recorded, over time."""

from collections import Counter
from dataclasses import dataclass, replace
from typing import Final

import numpy as np
from numpy.typing import NDArray

Series = NDArray[np.float64]

AXES: Final = "XYZ"
"""The axes, in the order of the coordinates."""

TOLERANCE: Final = 1e-6
"""Tolerance of times that are compared [s]."""

LENGTHS: Final = {"mm": 0.001, "cm": 0.01, "dm": 0.1, "m": 1.0, "in": 0.0254, "ft": 0.3048}
"""Units of length [m]."""

LENGTH_NAMES: Final = {
    **{name: name for name in LENGTHS},
    **dict.fromkeys(("millimeter", "millimeters", "millimetre", "millimetres"), "mm"),
    **dict.fromkeys(("centimeter", "centimeters", "centimetre", "centimetres"), "cm"),
    **dict.fromkeys(("decimeter", "decimeters", "decimetre", "decimetres"), "dm"),
    **dict.fromkeys(("meter", "meters", "metre", "metres"), "m"),
    **dict.fromkeys(("inch", "inches"), "in"),
    **dict.fromkeys(("foot", "feet"), "ft"),
}
"""Names of units, in lower case, with their symbols."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Motion:
    """Points over time, from one take of a file."""

    kind: str
    """The format of the file, such as ``a C3D file``."""
    names: tuple[str, ...]
    """The markers, joints or bodies."""
    times: Series
    """Time of each sample [s], shape (n,); the numbers of the frames if it is not ``clocked``."""
    positions: NDArray[np.float64]
    """Position of each point at each time [m], shape (n, points, 3); NaN where it was not seen."""
    places: NDArray[np.intp]
    """Line or frame of each sample in the file, shape (n,)."""
    place: str = "line"
    """The meaning of :attr:`places`."""
    unit: str
    """Unit of lengths in the file, even an unknown one; empty if neither the file nor its format
    states one."""
    metre: float
    """Metres per unit, by which the positions were multiplied."""
    up: str
    """Axis that points up."""
    up_source: str = ""
    """The origin of the axis: ``file`` or ``format``; empty if it is only a common one."""
    take: str = ""
    """Name of the take, if a file has several."""
    person: str = ""
    """Name of the person, if the file states it."""
    clocked: bool = True
    """Whether the file has times, or a rate."""
    second: float = 1.0
    """Seconds per unit, by which the times were multiplied."""
    hand: str = ""
    """Name of the point that is the hand, if the file states it."""

    def __post_init__(self) -> None:
        assert self.positions.shape == (len(self.times), len(self.names), 3)
        assert len(self.places) == len(self.times)

    def finite(self) -> "Motion":
        """Return the motion with NaN for the times and positions that are not finite."""
        times, positions = (
            np.where(np.isfinite(values), values, np.nan) for values in (self.times, self.positions)
        )
        return replace(self, times=times, positions=positions)

    def told_apart(self) -> "Motion":
        """Return the motion with points of one name numbered as if by subject: ``2:RFIN``."""
        total, found = Counter(self.names), Counter[str]()
        names: list[str] = []
        for name in self.names:
            found[name] += 1
            names.append(f"{found[name]}:{name}" if total[name] > 1 else name)
        return replace(self, names=tuple(names))

    def in_unit(self, metre: float, unit: str) -> "Motion":
        """Return the motion with its lengths read in another unit of so many metres."""
        return replace(
            self, positions=self.positions * (metre / self.metre), metre=metre, unit=unit
        )

    def in_time_unit(self, second: float) -> "Motion":
        """Return the motion with its times read in another unit of so many seconds."""
        return replace(self, times=self.times * (second / self.second), second=second)

    def at_rate(self, rate: float) -> "Motion":
        """Return the motion with times counted from its samples, ``rate`` of them per second.

        Where the file numbers its frames and has no times, missing frames stay missing.
        """
        frames = np.arange(len(self.times)) if self.clocked else self.times - self.times[:1]
        return replace(self, times=frames / rate, clocked=True)

    def between(self, start: float, stop: float) -> "Motion":
        """Return a part of the motion, in seconds from its first sample.

        It ends where the clock first comes to ``stop``, even if it is set back after that.
        """
        since = self.times - self.times[:1]
        kept = (since >= start) & (since <= stop + TOLERANCE)
        reached = since >= stop - TOLERANCE
        if reached.any():
            kept[reached.argmax() + 1 :] = False
        return replace(
            self,
            times=self.times[kept],
            positions=self.positions[kept],
            places=self.places[kept],
        )

    def where(self, sample: int) -> str:
        """Return the place of a sample in words, such as ``line 12``."""
        return f"{self.place} {self.places[sample]}"

    def heights(self, point: int, up: str) -> Series:
        """Return the height of a point over time [m], shape (n,).

        Parameters
        ----------
        point
            Its index in :attr:`names`.
        up
            The axis that points up; ``-Y`` if Y points down.
        """
        values = self.positions[:, point, AXES.index(up[-1])]
        return -values if up.startswith("-") else values


def zeros(motion: Motion) -> NDArray[np.bool_]:
    """Return where all coordinates of a point are 0: it was not seen. Shape (n, points)."""
    return np.asarray((motion.positions == 0.0).all(axis=2))


def length_of(text: str) -> float | None:
    """Return the metres in a unit of length, or in a number of metres; None if it is neither."""
    name = LENGTH_NAMES.get(text.strip().lower())
    if name is not None:
        return LENGTHS[name]
    try:
        value = float(text)
    except ValueError:
        return None
    return value if 0.0 < value < np.inf else None


def stated_unit(text: str) -> tuple[str, float]:
    """Return symbol and length [m] of the unit that a file states; itself and 1 if it is unknown.

    An unknown unit is refused where nobody names another (:func:`.check_stated_unit`).
    """
    name = LENGTH_NAMES.get(text.strip().lower())
    return (text.strip(), 1.0) if name is None else (name, LENGTHS[name])
