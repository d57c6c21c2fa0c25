"""The random part common to all behaviours: goal, durations, rests and natural strokes."""

import math
from dataclasses import dataclass
from typing import Self

import numpy as np
from colift.agents.agent import FRAME
from colift.agents.humans.stroke import Motion, Submovement, stroke
from colift.agents.humans.subject import GOAL_RANGE, Subject

REST_BEFORE = (0.6, 1.6)
HOLD = (0.2, 0.8)
REST_AFTER = (0.6, 1.2)
"""Shortest and longest rest before, between and after the strokes [s].

Drawn anew in each episode from the same distribution for all behaviours, so that the time carries
no information for a robot.
"""

EXTRA_RISE = (0.03, 0.08)
"""Lowest and highest displacement of an extra submovement, relative to the stroke's."""
EXTRA_DURATION = (0.6, 1.0)
"""Shortest and longest extra submovement [s]."""


@dataclass(frozen=True, kw_only=True)
class MovementDraw:
    """The numbers drawn for one lift."""

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
    def sample(cls, subject: Subject, rng: np.random.Generator) -> Self:
        """Return the numbers of one lift, uniform in the subject's ranges.

        The range of heights is narrowed evenly on both sides until it lies inside ``GOAL_RANGE``,
        which keeps the subject's mean.
        """
        mean = subject.amplitude
        half = min(subject.amplitude_spread * mean, mean - GOAL_RANGE[0], GOAL_RANGE[1] - mean)
        height, up, down, before, hold, after = rng.random(6).tolist()
        factors = (1.0 - subject.duration_spread, 1.0 + subject.duration_spread)
        return cls(
            height=interpolate((mean - half, mean + half), height),
            up=_whole_frames(subject.duration * interpolate(factors, up)),
            down=_whole_frames(
                subject.duration * subject.lowering_ratio * interpolate(factors, down)
            ),
            before=interpolate(REST_BEFORE, before),
            hold=interpolate(HOLD, hold),
            after=interpolate(REST_AFTER, after),
        )

    def duration(self, rise: float) -> float:
        """Return the duration [s] of a movement over ``rise`` [m], up or (negative) down.

        It grows with the square root of the distance.
        """
        full = self.up if rise > 0.0 else self.down
        return _whole_frames(full * float(np.sqrt(abs(rise) / self.height)))


def interpolate(limits: tuple[float, float], fraction: float) -> float:
    """Return the value at a ``fraction`` (0 to 1) between the lower and the upper limit."""
    low, high = limits
    return low + (high - low) * fraction


def interpolate_log(limits: tuple[float, float], fraction: float) -> float:
    """Return the value at a ``fraction`` (0 to 1) between two positive limits, in the logarithm."""
    low, high = limits
    return math.exp(interpolate((math.log(low), math.log(high)), fraction))


def _whole_frames(duration: float) -> float:
    return round(duration / FRAME) * FRAME


def natural_stroke(
    subject: Subject, rise: float, duration: float, rng: np.random.Generator
) -> Motion:
    """Return a stroke over ``rise`` [m], up or down, with the subject's skew and submovements.

    Parameters
    ----------
    duration : [s]
    """
    fewest, most = subject.submovements
    count = int(rng.integers(fewest, most + 1))
    extra = [_extra(rise, duration, *drawn) for drawn in rng.random((count, 3)).tolist()]
    skew = subject.skew_up if rise > 0.0 else subject.skew_down
    return stroke(rise, duration, skew=skew, extra=extra)


def _extra(rise: float, duration: float, size: float, length: float, onset: float) -> Submovement:
    lasting = min(interpolate(EXTRA_DURATION, length), duration)
    return Submovement(
        start=(duration - lasting) * onset,
        duration=lasting,
        rise=rise * interpolate(EXTRA_RISE, size),
    )
