"""People for training only, whose hands are not still until a lift nor back where it began."""

import dataclasses
from dataclasses import dataclass
from typing import Final

import numpy as np
from colift.agents.agent import FRAME
from colift.agents.estimators.minimum_jerk import profile
from colift.agents.humans import ChangingGoal, Jerky, Pause, Plan, Smooth, Subject
from colift.agents.humans.movement import REST_AFTER, interpolate, interpolate_log
from colift.agents.humans.plan import Behaviour, assemble
from colift.agents.humans.recorded import by_speed
from colift.agents.humans.stroke import Submovement, superpose
from numpy.typing import NDArray

Array = NDArray[np.float64]

WAYS: Final[tuple[Behaviour, ...]] = (
    Smooth(),
    Smooth(),
    Smooth(),
    Pause(),
    Jerky(),
    ChangingGoal(),
)
"""Ways of lifting, equally likely: half of the lifts are smooth."""


HALTING: Final = (0.15, 0.85)
"""Earliest and latest halt, relative to the stroke's duration."""

RECOIL: Final = (-0.2, 0.4)
"""Earliest and latest recoil after the end of the lowering [s]."""

TURNING: Final = (-0.4, 0.4)
"""Range of the rest at the turn of a counter-movement [s]; half of them turn at once."""

ONWARDS: Final = (-1.0, 0.6)
"""Earliest and latest lift after the end of a counter-movement, relative to the way back."""


@dataclass(frozen=True, kw_only=True)
class Unsettled:
    """Lifts with waits, counter-movements, brief halts, and an end above or below the start.

    Recorded people rest for seconds before a lift, dip before they rise, and let their hands come
    to rest elsewhere. None of the suites' behaviours does so. Each habit occurs in a share of the
    lifts, independently of the others, at a pace of its own.
    """

    stroke: tuple[float, float] = (1.0, 4.0)
    """Shortest and longest upward stroke [s], uniform in its logarithm."""
    waits: float = 0.5
    """Share of the lifts before which the hand waits longer than in other behaviours."""
    wait: tuple[float, float] = (0.3, 6.0)
    """Shortest and longest additional wait [s], uniform in its logarithm."""
    counters: float = 0.5
    """Share of the lifts that begin with a counter-movement."""
    counter: tuple[float, float] = (0.003, 0.03)
    """Smallest and largest counter-movement [m]."""
    false_starts: float = 0.25
    """Share of the counter-movements that go up and back instead of down."""
    halts: float = 0.25
    """Share of the lifts that halt on the way."""
    halt: tuple[float, float] = (0.05, 1.0)
    """Shortest and longest halt [s], uniform in its logarithm."""
    braking: tuple[float, float] = (0.1, 0.5)
    """Shortest and longest braking before it and acceleration after it [s]."""
    holds: float = 0.3
    """Share of the lifts that stay at the top for longer, as long as a wait."""
    shifts: float = 0.6
    """Share of the lifts that end above or below the start."""
    end: tuple[float, float] = (-0.03, 0.03)
    """Lowest and highest end [m]."""
    recoils: float = 0.5
    """Share of these lifts after which the hand moves on to another height in that range."""
    stay: tuple[float, float] = (0.3, 4.0)
    """Shortest and longest stay at the end, before the hand returns to its start [s], uniform in
    its logarithm."""
    pace: tuple[float, float] = (0.25, 2.6)
    """Shortest and longest part of a counter-movement, recoil, or return [s], uniform in its
    logarithm."""

    def plan(self, subject: Subject, seed: int) -> Plan:
        """Return the plan of one episode; pure in ``(self, subject, seed)``."""
        rng = np.random.default_rng(seed)
        person = dataclasses.replace(subject, duration=interpolate_log(self.stroke, rng.random()))
        way = WAYS[int(rng.integers(len(WAYS)))]
        lift = way.plan(person, int(rng.integers(2**32)))
        (onset, risen), (lowering, end) = lift.strokes[0], lift.strokes[-1]
        heights = self._ended(lift.target[:end], lowering, rng)
        heights = self._halted(heights, lowering, end, rng)
        if rng.random() < self.holds:
            heights = _stretched(heights, lowering, interpolate_log(self.wait, rng.random()))
        heights = self._halted(heights, onset, risen, rng)
        heights = self._countered(heights, onset, rng)
        if rng.random() < self.waits:
            heights = _stretched(heights, onset, interpolate_log(self.wait, rng.random()))
        return assemble(*by_speed(heights))

    def _ended(self, heights: Array, lowering: int, rng: np.random.Generator) -> Array:
        """Return the lift with its end, for a lowering from a frame until the last one."""
        time = (len(heights) - lowering) * FRAME
        pieces, level = [], 0.0
        if rng.random() < self.shifts:
            level = interpolate(self.end, rng.random())
            pieces.append(Submovement(start=0.0, duration=time, rise=level))
            if rng.random() < self.recoils:
                following, pace = interpolate(self.end, rng.random()), self._pace(rng)
                start = time + interpolate(RECOIL, rng.random())
                pieces.append(Submovement(start=start, duration=pace, rise=following - level))
                level, time = following, start + pace
            time += interpolate_log(self.stay, rng.random())
            back = self._pace(rng)
            pieces.append(Submovement(start=time, duration=back, rise=-level))
            time += back
        rest = round((time + interpolate(REST_AFTER, rng.random())) / FRAME)
        ended = np.concatenate((heights, np.zeros(lowering + rest - len(heights))))
        if pieces:
            ended[lowering:] += superpose(pieces, rest)[0]
        return ended

    def _halted(self, heights: Array, start: int, stop: int, rng: np.random.Generator) -> Array:
        """Return the lift with a halt between two frames, in some."""
        if rng.random() >= self.halts:
            return heights
        first = start + round((stop - start) * interpolate(HALTING, rng.random()))
        brake = round(interpolate(self.braking, rng.random()) / FRAME)
        slower = 1.0 - profile(np.arange(1, brake + 1) / brake)
        halt = np.zeros(round(interpolate_log(self.halt, rng.random()) / FRAME))
        pace = np.concatenate((slower, halt, slower[::-1]))
        # Braking and acceleration cover brake - 1 frames of the lift together.
        halting = np.interp(first + pace.cumsum(), np.arange(len(heights)), heights)
        return np.concatenate((heights[: first + 1], halting, heights[first + brake :]))

    def _countered(self, heights: Array, onset: int, rng: np.random.Generator) -> Array:
        """Return the lift with a counter-movement before or into its onset, in some."""
        if rng.random() >= self.counters:
            return heights
        size, away, back = interpolate(self.counter, rng.random()), self._pace(rng), self._pace(rng)
        turn = away + max(interpolate(TURNING, rng.random()), 0.0)
        up = rng.random() < self.false_starts
        lag = interpolate(ONWARDS, rng.random())
        # A lift on top of a false start would leave the robot's reach.
        begun = turn + back * (1.0 + max(lag, 0.0) if up else max(1.0 + lag, 0.0))
        rise = size if up else -size
        pieces = (
            Submovement(start=0.0, duration=away, rise=rise),
            Submovement(start=turn, duration=back, rise=-rise),
        )
        countered = _stretched(heights, onset, begun)
        countered[onset:] += superpose(pieces, len(countered) - onset)[0]
        return countered

    def _pace(self, rng: np.random.Generator) -> float:
        return interpolate_log(self.pace, rng.random())


def _stretched(heights: Array, frame: int, time: float) -> Array:
    """Return the motion with a rest of that time [s] before a frame, at the height there."""
    return np.insert(heights, frame, np.full(round(time / FRAME), heights[max(frame - 1, 0)]))
