"""The choices of the user on the way from a file to lifts."""

from dataclasses import dataclass, field

from colift.benchmark.recordings.cutting import Cut
from colift.benchmark.recordings.motion import Motion


@dataclass(frozen=True, kw_only=True)
class Wishes:
    """The choices of the user."""

    hand: str | None = None
    """The point of the hand; None leaves it to the file."""
    far: str | None = None
    """The point of the other end."""
    up: str | None = None
    """The axis that points up, such as ``Y`` or ``-Y``."""
    unit: str | None = None
    """Name of the unit of lengths, or metres per unit."""
    metre: float | None = None
    """Metres in it."""
    rate: float | None = None
    """Samples per second, counted instead of the file's times."""
    second: float | None = None
    """Unit of times [s]."""
    between: tuple[float, float] | None = None
    """The part that is read, in seconds from the first sample."""
    fill: float = 0.0
    """Longest gap that is filled [s]."""
    person: str | None = None
    """Regular expression of the part of the file's name that names the person."""
    leave_out: bool = False
    """Whether what cannot be used is left out, instead of refused."""
    cut: Cut = field(default_factory=Cut)

    def applied(self, motion: Motion) -> Motion:
        """Return a motion in the units of time and length, at the rate and in the part chosen."""
        if self.second is not None:
            motion = motion.in_time_unit(self.second)
        if self.rate is not None:
            motion = motion.at_rate(self.rate)
        if self.metre is not None:
            motion = motion.in_unit(self.metre, str(self.unit))
        if self.between is not None:
            motion = motion.between(*self.between)
        return motion
