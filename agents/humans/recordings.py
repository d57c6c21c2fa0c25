"""Recorded lifts."""

from dataclasses import dataclass
from typing import Final

from colift.base.errors import InputError

COLUMNS: Final = ("trial", "t_s", "z_m")
"""Columns of a file of recordings."""

PERSON: Final = "person"
"""A further column that a file can have: the name of the person who was recorded."""

PHASE: Final = "phase"
"""A further column: the part of the lift, such as ``rise``, by any name; empty in between."""

FAR: Final = "z_far_m"
"""A further column: height of the other person's end [m], from the origin of ``z_m``."""

TILT: Final = "tilt_deg"
"""A further column: inclination of the table [deg], positive if the end of ``z_m`` is the higher
one."""

FORCE: Final = "force_n"
"""A further column: vertical force at the hand [N], from any zero."""

BESIDE: Final = (FAR, TILT, FORCE)
"""The further columns with a number in each sample."""

LEAST_MOVEMENT: Final = 0.01
"""Least range of the heights of a lift [m]."""

LARGEST_MOVEMENT: Final = 1e4
"""Largest range of the heights of a lift [m], in any plausible unit."""

LONGEST: Final = 120.0
"""Longest recording [s]; beyond it, the unit of time is wrong."""


@dataclass(frozen=True, kw_only=True)
class Recording:
    """The height of a person's hand over time, as recorded."""

    name: str
    """The trial."""
    times: tuple[float, ...]
    """Time of each sample [s], increasing, at any rate."""
    heights: tuple[float, ...]
    """Height at each time [m], from any origin."""
    person: str = ""
    """Name of the person; empty if it is not known."""

    def __post_init__(self) -> None:
        if len(self.times) != len(self.heights):
            raise InputError(
                f"trial {self.name!r}: {len(self.times)} times but {len(self.heights)} heights"
            )
        if len(self.times) < 2:
            raise InputError(
                f"trial {self.name!r} has {len(self.times)} sample(s), needs at least 2"
            )
        for before, after in zip(self.times, self.times[1:], strict=False):
            if not after > before:
                raise InputError(
                    f"trial {self.name!r}: time goes from {before} s to {after} s, must increase"
                )
        lasting = self.times[-1] - self.times[0]
        if lasting > LONGEST:
            raise InputError(
                f"trial {self.name!r} lasts {lasting:g} s, must be at most {LONGEST:g} s "
                "(is t_s in seconds?)"
            )
        span = max(self.heights) - min(self.heights)
        if span > LARGEST_MOVEMENT:
            raise InputError(
                f"trial {self.name!r}: its heights span {span:g} m, must be at most "
                f"{LARGEST_MOVEMENT:g} m (is z_m in metres?)"
            )
        if span < LEAST_MOVEMENT:
            raise InputError(
                f"trial {self.name!r} does not move: its heights span {span:.4f} m, must be at "
                f"least {LEAST_MOVEMENT} m (is z_m in metres?)"
            )
