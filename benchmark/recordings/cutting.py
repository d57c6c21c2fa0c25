"""Lifts in a long recording: where the hand rises, and what comes after.

Heights are smoothed over :data:`SMOOTH`. The hand rises while it is faster than :data:`SPEED`;
rises with a pause of less than ``pause`` between them are one, unless the hand sinks in between by
more than :data:`SINKS` of them. A rise counts if it is at least ``least`` high. It begins where the
hand was last within :data:`EDGE` of its height from its lowest point, and ends where the hand is
first within this share of its highest one. What sinks is found in the same way.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from typing import Final, NamedTuple

import numpy as np
from colift.benchmark.recordings.motion import Series
from colift.benchmark.recordings.unseen import gaps_in

STEP: Final = 0.01
"""Interval at which heights are looked at [s]."""

SMOOTH: Final = 0.2
"""Width of the triangle by which heights are smoothed [s]: noise of a depth camera, of 1 cm at 30
Hz, becomes slower than a lift."""

SPEED: Final = 0.02
"""Least speed of a hand that rises [m/s]; the slowest lifts of :mod:`.artefacts` peak at 0.9
m/s, and a person who stands still sways at 0.01 m/s."""

SINKS: Final = 0.2
"""Share of a rise by which the hand may sink in a pause of it."""

NOISE: Final = 0.2
"""Share of the least rise up to which what rises is noise."""

EDGE: Final = 0.02
"""Share of a rise at its start and end that counts as rest."""

BLIND: Final = 1.0
"""Longest time without a sample across which a movement is followed [s]."""

PHASES: Final = ("rise", "hold", "lower")
"""The phases of a lift, in order."""


class Span(NamedTuple):
    """A part of a recording [s]."""

    start: float
    stop: float


@dataclass(frozen=True, kw_only=True)
class Cut:
    """The settings by which lifts are cut."""

    phases: int = 1
    """The number of phases of :data:`PHASES` that are kept; 0 keeps the recording whole."""
    least: float = 0.05
    """Least height of a rise [m]."""
    pause: float = 1.0
    """Longest pause in a rise [s]."""
    margin: float = 0.5
    """Longest rest before and after a lift that is kept [s]."""


@dataclass(frozen=True, kw_only=True)
class Lift:
    """A lift in a recording: its phases, and the part with the rests around them."""

    phases: tuple[Span, ...]
    """Rise, hold and lowering, as far as they are kept; none if nothing was cut."""
    whole: Span

    @property
    def span(self) -> Span:
        """The lift without the rests around it."""
        if not self.phases:
            return self.whole
        return Span(self.phases[0].start, self.phases[-1].stop)

    def phase_at(self, time: float) -> str:
        """Return the phase at a time [s]; empty at rest."""
        for name, span in zip(PHASES, self.phases, strict=False):
            if span.start <= time <= span.stop:
                return name
        return ""


def lifts_in(times: Series, heights: Series, cut: Cut) -> list[Lift]:
    """Return the lifts in a recording, in order.

    Parameters
    ----------
    times
        [s], shape (n,), increasing.
    heights
        [m], shape (n,); NaN where the hand was not seen.
    cut
        The settings.
    """
    if not cut.phases:
        seen = times[~np.isnan(heights)]
        still = not seen.size or np.ptp(heights[~np.isnan(heights)]) < cut.least
        return [] if still else [Lift(phases=(), whole=Span(float(seen[0]), float(seen[-1])))]
    found: list[Lift] = []
    for part in _parts(times, heights):
        t, z = times[part], heights[part]
        seen = ~np.isnan(z)
        grid = np.arange(t[0], t[-1] + 0.5 * STEP, STEP)
        smooth = _smoothed(np.interp(grid, t[seen], z[seen]))
        rises = [*_rises(grid, smooth, cut)]
        falls = [*_rises(grid, -smooth, cut)]
        found += _lifts(rises, falls, Span(float(t[0]), float(t[-1])), cut)
    return found


def rise_in(times: Series, heights: Series, cut: Cut) -> float:
    """Return the height of the highest rise of a recording [m]; 0 if there is none."""
    seen = ~np.isnan(heights)
    t, z = times[seen], heights[seen]
    lifts = lifts_in(times, heights, replace(cut, phases=1))
    spans = [lift.phases[0] for lift in lifts]
    return max((float(np.interp(b, t, z) - np.interp(a, t, z)) for a, b in spans), default=0.0)


def _parts(times: Series, heights: Series) -> Iterator[slice]:
    """Yield the parts of a recording between long gaps, without unseen samples at their ends."""
    seen = np.flatnonzero(~np.isnan(heights))
    if not seen.size:
        return
    edges = np.flatnonzero(np.diff(times[seen]) > BLIND)
    for first, last in zip([0, *(edges + 1)], [*edges, len(seen) - 1], strict=True):
        if last - first >= 2:
            yield slice(int(seen[first]), int(seen[last]) + 1)


def _smoothed(heights: Series) -> Series:
    """Return heights, smoothed twice by a mean over half of :data:`SMOOTH`."""
    half = round(0.5 * SMOOTH / STEP) // 2
    kernel = np.full(2 * half + 1, 1.0 / (2 * half + 1))
    for _ in range(2):
        heights = np.convolve(np.pad(heights, half, mode="edge"), kernel, mode="valid")
    return heights


def _rises(grid: Series, heights: Series, cut: Cut) -> Iterator[Span]:
    """Yield the rises of smoothed heights."""
    speed = np.gradient(heights, STEP) if len(heights) > 1 else np.zeros(len(heights))
    edges = np.flatnonzero(np.diff(speed > SPEED, prepend=False, append=False)).tolist()
    ends = zip(edges[::2], (stop - 1 for stop in edges[1::2]), strict=True)
    runs = [(a, b) for a, b in ends if heights[b] - heights[a] > NOISE * cut.least]
    for start, stop in _joined(runs, heights, cut.pause):
        low = start + int(heights[start : stop + 1].argmin())
        high = low + int(heights[low : stop + 1].argmax())
        rise = float(heights[high] - heights[low])
        if rise < cut.least:
            continue
        up = heights[low : high + 1] - heights[low]
        leaves = int((up > 10.0 * EDGE * rise).argmax())
        first = low + int(np.flatnonzero(up[: leaves + 1] <= EDGE * rise)[-1])
        arrives = len(up) - 1 - int((up[::-1] < (1.0 - 10.0 * EDGE) * rise).argmax())
        last = low + arrives + int((up[arrives:] >= (1.0 - EDGE) * rise).argmax())
        yield Span(float(grid[first]), float(grid[last]))


def _joined(
    runs: Sequence[tuple[int, int]], heights: Series, pause: float
) -> list[tuple[int, int]]:
    """Return runs in which the hand rises, joined over short pauses in which it hardly sinks."""
    joined: list[tuple[int, int]] = []
    for start, stop in runs:
        if joined:
            first, last = joined[-1]
            risen = max(heights[last] - heights[first], heights[stop] - heights[start])
            sunk = heights[last] - heights[last : start + 1].min()
            if (start - last) * STEP <= pause and sunk <= SINKS * risen:
                joined[-1] = first, stop
                continue
        joined.append((start, stop))
    return joined


def _lifts(rises: Sequence[Span], falls: Sequence[Span], part: Span, cut: Cut) -> Iterator[Lift]:
    """Yield the lift of each rise of a part of the recording."""
    for i, rise in enumerate(rises):
        following = rises[i + 1].start if i + 1 < len(rises) else part.stop
        fall = next((fall for fall in falls if rise.stop <= fall.start < following), None)
        hold = Span(rise.stop, fall.start if fall else following)
        phases = (rise, hold, fall)[: cut.phases] if fall else (rise, hold)[: cut.phases]
        kept = tuple(span for span in phases if span is not None)
        before = [span.stop for span in (*rises, *falls) if span.stop <= rise.start]
        after = [span.start for span in (*rises, *falls) if span.start >= kept[-1].stop]
        start = max(rise.start - cut.margin, part.start, *before)
        stop = min(kept[-1].stop + cut.margin, part.stop, *after)
        yield Lift(phases=kept, whole=Span(start, stop))


def broken(times: Series, heights: Series, lift: Lift) -> bool:
    """Return whether a lift begins or ends beside a long gap: it was not seen whole."""
    first, last = lift.span
    for gap in gaps_in(heights):
        before, after = times[max(gap.start - 1, 0)], times[min(gap.stop, len(times) - 1)]
        if gap.seconds(times) > BLIND and (
            abs(before - last) <= SMOOTH or abs(after - first) <= SMOOTH
        ):
            return True
    return False


def cut_off(times: Series, heights: Series, lift: Lift) -> bool:
    """Return whether the hand was already rising at the first sample of a lift.

    Then it is faster there than half its mean speed.
    """
    if not lift.phases:
        return False
    start, stop = lift.phases[0]
    t, z = times[~np.isnan(heights)], heights[~np.isnan(heights)]
    if start - t[0] > SMOOTH:
        return False
    first, high = np.interp([t[0] + 0.5 * SMOOTH, stop], t, z) - z[0]
    return bool(first / (0.5 * SMOOTH) > 0.5 * high / (stop - t[0]))
