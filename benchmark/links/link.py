"""A link: the delays and losses of messages in one direction."""

from dataclasses import dataclass
from typing import Final

from colift.base.errors import InputError

JITTERS: Final = ("gamma", "lognormal")
"""Families of the jitter."""

LONGEST_DELAY: Final = 10.0
"""Largest delay, and largest mean and deviation of the jitter [s]."""

LONGEST_BURST: Final = 1000.0
"""Largest mean number of messages that are lost in a row."""

MOST_SPREAD: Final = 100.0
"""Largest ratio of the jitter's deviation to its mean."""


@dataclass(frozen=True, kw_only=True)
class Link:
    """One direction; without parameters, one that delays and loses nothing.

    The one-way delay of a message is ``delay`` plus a jitter, independent of that of other
    messages: a message may overtake an earlier one. A shifted gamma distribution describes delays
    on the Internet (A. Mukherjee, "On the dynamics and significance of low frequency components of
    Internet load", Internetworking: Research and Experience 5, 1994; C. J. Bovy et al., "Analysis
    of end-to-end delay measurements in Internet", PAM 2002). The log-normal one has a heavier tail.

    Losses follow E. N. Gilbert ("Capacity of a burst-noise channel", Bell System Technical Journal
    39, 1960), with a bad state in which every message is lost and a good one in which none is.
    After each message the state changes

        from good to bad with the probability  loss / (burst (1 - loss)),
        from bad to good with the probability  1 / burst,

    so that the share ``loss`` of all messages is lost, ``burst`` in a row on average.

    Raises
    ------
    InputError
        If a number is out of range; the message names the range.
    """

    delay: float = 0.0
    """Shortest one-way delay [s]."""
    jitter: str = "gamma"
    """Family of the jitter: ``gamma`` or ``lognormal``."""
    jitter_mean: float = 0.0
    """Mean of the jitter [s]."""
    jitter_deviation: float = 0.0
    """Standard deviation of the jitter [s]; 0 for a constant jitter."""
    loss: float = 0.0
    """Share of messages that are lost, in [0, 1]."""
    burst: float = 1.0
    """Mean number of messages that are lost in a row."""

    def __post_init__(self) -> None:
        """Check the ranges."""
        if self.jitter not in JITTERS:
            raise InputError(f"jitter must be {' or '.join(JITTERS)}, got {self.jitter!r:.80}")
        for name in ("delay", "jitter_mean", "jitter_deviation"):
            _check(name, getattr(self, name), 0.0, LONGEST_DELAY, " s")
        if self.jitter_deviation > MOST_SPREAD * self.jitter_mean:
            raise InputError(
                f"jitter_deviation must be at most {MOST_SPREAD:g} times jitter_mean "
                f"({self.jitter_mean:g} s), got {self.jitter_deviation:g} s"
            )
        _check("loss", self.loss, 0.0, 1.0)
        _check("burst", self.burst, 1.0, LONGEST_BURST)
        if self.loss < 1.0 and self.loss > self.burst * (1.0 - self.loss):
            raise InputError(
                f"burst must be at least loss / (1 - loss) = {self.loss / (1 - self.loss):g} for a "
                f"loss of {self.loss:g}, got {self.burst:g}"
            )

    @property
    def ends_burst(self) -> float:
        """Probability that the message after a lost one is not lost."""
        return 0.0 if self.loss == 1.0 else 1.0 / self.burst

    @property
    def begins_burst(self) -> float:
        """Probability that the message after one that is not lost is lost."""
        return 1.0 if self.loss == 1.0 else self.loss / (self.burst * (1.0 - self.loss))

    def __str__(self) -> str:
        """Return the numbers in words."""
        text = f"{_ms(self.delay)} ms"
        if self.jitter_mean:
            spread = f" ± {_ms(self.jitter_deviation)}" if self.jitter_deviation else ""
            text += f" + {_ms(self.jitter_mean)}{spread} ms ({self.jitter})"
        if self.loss:
            text += f", {100 * self.loss:g} % lost"
            text += f", {self.burst:g} in a row" if 0 < self.loss < 1 else ""
        return text


def _check(name: str, value: float, lowest: float, highest: float, unit: str = "") -> None:
    if not lowest <= value <= highest:
        raise InputError(
            f"{name} must be from {lowest:g} to {highest:g}{unit}, got {value:g}{unit}"
        )


def _ms(seconds: float) -> str:
    return f"{1000 * seconds:g}"
