"""A person's recorded movement, scaled to the table."""

from dataclasses import dataclass
from typing import Final

import numpy as np
from colift.agents.agent import FRAME
from colift.agents.estimators.minimum_jerk import profile
from colift.agents.humans.movement import REST_AFTER, REST_BEFORE, interpolate
from colift.agents.humans.plan import Plan, Segment, assemble, move, still
from colift.agents.humans.recordings import LEAST_MOVEMENT, Recording
from colift.agents.humans.stroke import stroke
from colift.agents.humans.subject import Subject
from colift.base.errors import InputError
from numpy.typing import NDArray

PEAK: Final = 0.20
"""Height [m] to which a recording is scaled."""

ROOM_BELOW: Final = 0.03
"""Largest dip of a recording below its start [m]."""

FASTEST: Final = 0.20
"""Highest speed [m/s]; people coupled to a robot move three to five times slower than alone."""

RETURN: Final = (0.8, 0.15)
"""Shortest duration [s] and highest speed [m/s] of the return from the recording's last height."""

KNOT: Final = 0.04
"""Interval of the smoothing spline's knots [s]: -3 dB at about 6 Hz, usual for motion capture."""

EASE: Final = 0.4
"""Time in which the recording accelerates to full pace, and slows down at its end [s]."""

MOVING: Final = (0.008, 0.02)
"""A stroke exceeds the second speed [m/s] and lasts while the speed is above the first."""


@dataclass(frozen=True, kw_only=True)
class Recorded:
    """Moves as a person was recorded to move."""

    recording: Recording

    def plan(self, subject: Subject, seed: int) -> Plan:
        """Return the plan of one episode; pure in ``(self, seed)``.

        The recording is inverted if it descends, scaled to a peak of 0.20 m (less where its dip
        below the start would not fit), slowed down to at most 0.20 m/s (never sped up), smoothed
        and eased in and out. From its last height the hand returns to the start. The seed draws the
        rests before and after; the subject has no effect on the plan.

        Raises
        ------
        InputError
            If no lift is left after smoothing, as for a lone outlier.
        """
        before, after = np.random.default_rng(seed).random(2).tolist()
        return assemble(
            still("ready", 0.0, interpolate(REST_BEFORE, before)),
            *by_speed(_retarget(self.recording)),
            still("rest", 0.0, interpolate(REST_AFTER, after)),
        )


def _retarget(recording: Recording) -> NDArray[np.float64]:
    """Return the recorded movement at 100 Hz, from height 0 and back to it."""
    times = np.array(recording.times)
    times -= times[0]
    heights = np.array(recording.heights)
    heights -= heights[0]
    if -heights.min() > heights.max():
        heights = -heights

    duration = float(times[-1])
    knot = max(KNOT, float(np.median(np.diff(times))))
    control = np.interp(knot * np.arange(-1, np.ceil(duration / knot) + 3), times, heights)
    shape = _spline(control, np.linspace(0.0, duration / knot, 4 * round(duration / FRAME) + 2))
    control -= shape[0]
    shape -= shape[0]
    highest, dip = float(shape.max()), float(-shape.min())
    if highest < 0.5 * LEAST_MOVEMENT:
        raise InputError(
            f"trial {recording.name!r} does not move: after smoothing it rises {highest:.4f} m "
            f"above its start, must be at least {0.5 * LEAST_MOVEMENT} m"
        )
    scale = PEAK / highest if dip * PEAK <= ROOM_BELOW * highest else ROOM_BELOW / dip

    # A spline is never steeper than its control polygon.
    steepest = scale * float(np.abs(np.diff(control)).max()) / knot
    full_pace = int(np.ceil(duration * max(steepest / FASTEST, 1.0) / FRAME))
    ease = min(round(EASE / FRAME), full_pace)
    ramp = profile(np.arange(1, ease + 1) / ease)
    pace = np.ones(full_pace + ease)
    pace[:ease] = ramp
    pace[-ease:] = ramp[::-1]
    time = pace.cumsum()
    time *= duration / (knot * time[-1])
    lift = scale * _spline(control, time)

    # The return begins while the recording slows down: the hand does not halt.
    end = float(lift[-1])
    shortest, speed = RETURN
    back = stroke(-end, max(shortest, 1.875 * abs(end) / speed))[0]
    overlap = ease // 2
    whole = np.concatenate((lift, np.full(len(back) - overlap, end)))
    whole[len(lift) - overlap :] += back
    return whole


def _spline(control: NDArray[np.float64], u: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return the uniform cubic B-spline at ``u`` intervals after ``control[1]``.

    It smooths (variance of its kernel: a third of an interval squared) and never overshoots.
    """
    first = u.astype(np.intp)
    f = u - first
    g = 1.0 - f
    cubic = f * f * f
    return np.asarray(
        (
            control[first] * (g * g * g)
            + control[first + 1] * (4.0 - 6.0 * f * f + 3.0 * cubic)
            + control[first + 2] * (1.0 + 3.0 * (f + f * f - cubic))
            + control[first + 3] * cubic
        )
        / 6.0
    )


def by_speed(heights: NDArray[np.float64]) -> list[Segment]:
    """Return the movement divided into strokes and rests, by its speed with hysteresis."""
    velocity = np.diff(heights, prepend=0.0) / FRAME
    speed = np.abs(velocity)
    lowest, highest = MOVING
    edges = np.flatnonzero(np.diff(speed > lowest, prepend=False, append=False)).tolist()
    segments: list[Segment] = []
    frame = 0
    for start, stop in zip(edges[::2], edges[1::2], strict=True):
        if speed[start:stop].max() <= highest:
            continue
        if start > frame:
            segments.append(Segment("hold" if frame else "begin", heights[frame:start], False))
        up = velocity[start:stop].sum() > 0.0
        segments.append(move("rise" if up else "lower", heights[start:stop]))
        frame = stop
    segments.append(Segment("end", heights[frame:], False))
    return segments
