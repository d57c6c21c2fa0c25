"""The draws that every behaviour shares: height, times, natural strokes."""

from dataclasses import dataclass
from typing import Self

import numpy as np

from ..agent import FRAME
from .stroke import Motion, Submovement, stroke
from .subject import GOAL_RANGE, Subject

REST_BEFORE = (0.6, 1.6)
HOLD = (0.2, 0.8)
REST_AFTER = (0.6, 1.2)
"""Shortest and longest rest before, between and after the strokes [s].

Drawn anew in each episode and alike for all behaviours, so that time tells a robot nothing.
"""

EXTRA_SHARE = (0.03, 0.08)
"""Lowest and highest displacement of an extra submovement, relative to the stroke's."""
EXTRA_DURATION = (0.6, 1.0)
"""Shortest and longest extra submovement [s]."""


@dataclass(frozen=True, kw_only=True)
class Lift:
    """The numbers of one lift."""

    height: float
    """Goal [m]."""
    up: float
    """Duration of the upward stroke [s]."""
    down: float
    """Duration of the lowering from ``height`` [s]."""
    before: float
    """Rest before the lift [s]."""
    hold: float
    """Rest at the top [s]."""
    after: float
    """Rest after the lowering [s]."""

    @classmethod
    def draw(cls, subject: Subject, rng: np.random.Generator) -> Self:
        """Return a lift of the subject, uniform in the subject's ranges.

        The range of heights is narrowed evenly on both sides until it lies inside ``GOAL_RANGE``,
        which keeps the subject's mean.
        """
        mean = subject.amplitude
        half = min(subject.amplitude_spread * mean, mean - GOAL_RANGE[0], GOAL_RANGE[1] - mean)
        height, up, down, before, hold, after = rng.random(6).tolist()
        spread = (1.0 - subject.duration_spread, 1.0 + subject.duration_spread)
        return cls(
            height=between((mean - half, mean + half), height),
            up=_whole_frames(subject.duration * between(spread, up)),
            down=_whole_frames(subject.duration * subject.lowering_ratio * between(spread, down)),
            before=between(REST_BEFORE, before),
            hold=between(HOLD, hold),
            after=between(REST_AFTER, after),
        )

    def duration(self, rise: float) -> float:
        """Return how long a movement over ``rise`` [m] takes, up or (negative) down [s].

        Shorter movements are slower but not in proportion: the time grows with the square root of
        the distance.
        """
        full = self.up if rise > 0.0 else self.down
        return _whole_frames(full * float(np.sqrt(abs(rise) / self.height)))


def between(limits: tuple[float, float], share: float) -> float:
    """Return the value at ``share`` (0 to 1) of the way from the lower to the upper limit."""
    low, high = limits
    return low + (high - low) * share


def _whole_frames(duration: float) -> float:
    return round(duration / FRAME) * FRAME


def natural_stroke(
    subject: Subject, rise: float, duration: float, rng: np.random.Generator
) -> Motion:
    """Return a stroke over ``rise`` [m], up or down, skewed and with submovements as the subject's.

    Parameters
    ----------
    duration : [s]
    """
    fewest, most = subject.submovements
    count = int(rng.integers(fewest, most + 1))
    extra = [_extra(rise, duration, *shares) for shares in rng.random((count, 3)).tolist()]
    skew = subject.skew_up if rise > 0.0 else subject.skew_down
    return stroke(rise, duration, skew=skew, extra=extra)


def _extra(rise: float, duration: float, size: float, length: float, onset: float) -> Submovement:
    lasting = min(between(EXTRA_DURATION, length), duration)
    return Submovement(
        start=(duration - lasting) * onset,
        duration=lasting,
        rise=rise * between(EXTRA_SHARE, size),
    )
