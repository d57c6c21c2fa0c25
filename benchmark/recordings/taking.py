"""The way from a file to lifts: read, choose, check, cut, fill."""

import re
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np
from colift.agents.humans.artefacts import SHORTEST, fault
from colift.base.errors import InputError
from colift.benchmark.recordings.checking import (
    check_clock,
    check_stated_unit,
    check_unit,
    with_gaps,
)
from colift.benchmark.recordings.choosing import Track, choose, other_axis
from colift.benchmark.recordings.cutting import Cut, Lift, broken, cut_off, lifts_in, rise_in
from colift.benchmark.recordings.kinds import read_motions
from colift.benchmark.recordings.motion import TOLERANCE, Motion, Series
from colift.benchmark.recordings.takes import Take, Taken
from colift.benchmark.recordings.unseen import filled, gaps_in
from colift.benchmark.recordings.upright import check_up, up_of
from colift.benchmark.recordings.wishes import Wishes


def takes_of(path: Path, wishes: Wishes) -> list[Take]:
    """Return the takes of a file, with their lifts.

    Raises
    ------
    InputError
        If the file cannot be read, a choice is open, or a take or a lift cannot be used and is not
        to be left out. The message names the file, the place, the value and the way out.
    """
    motions = read_motions(path)
    return [_take(path, motion, len(motions) > 1, wishes) for motion in motions]


def _take(path: Path, motion: Motion, several: bool, wishes: Wishes) -> Take:
    where = f"{path}, trial {motion.take!r:.60}" if several else str(path)
    if wishes.metre is None:
        check_stated_unit(motion, where)
    motion = wishes.applied(motion)
    check_clock(motion, where)
    motion = with_gaps(replace(motion, times=motion.times - motion.times[0]))
    up = up_of(motion, wishes.up, where)
    check_unit(motion, up, where)

    def rise(moved: Motion, heights: Series) -> float:
        return rise_in(moved.times, heights, wishes.cut)

    track = choose(motion, wishes.hand, wishes.far, up, rise, where)
    if wishes.up is None:
        check_up(track, rise, where)
    found = lifts_in(motion.times, track.heights, wishes.cut)
    problems = [] if found else [_nothing(track, wishes.cut, where)]
    made: list[Taken] = []
    count = 0
    name = motion.take or path.stem
    person = _person(path, wishes.person) if wishes.person else motion.person
    for i, lift in enumerate(found, 1):
        trial = name if len(found) == 1 else f"{name}-{i:0{len(str(len(found)))}d}"
        try:
            taken, some = _taken(track, lift, wishes, trial, person, where)
        except InputError as error:
            problems.append(str(error))
            continue
        made.append(taken)
        count += some
    if problems and not wishes.leave_out:
        raise InputError("\n".join(problems))
    return Take(file=path, track=track, lifts=tuple(made), left_out=tuple(problems), filled=count)


def _person(path: Path, pattern: str) -> str:
    found = re.search(pattern, str(path))
    if found is None:
        raise InputError(
            f"{path}: no part of the name matches --person {pattern!r:.60}: rename the file, or "
            "choose another pattern, such as 'S[0-9]+'"
        )
    return str(next((group for group in found.groups() if group), found[0]))


def _nothing(track: Track, cut: Cut, where: str) -> str:
    """Return why there is no lift, and what may help."""
    motion, heights = track.motion, track.heights
    seen = heights[~np.isnan(heights)]
    if not seen.size:
        return f"{where}: {track.hand} was never seen: choose another with --marker"
    text = (
        f"{where}: no lift: {track.hand} moves {np.ptp(seen):.3f} m along {track.up}, and never "
        f"rises by {cut.least:g} m at once"
    )
    if track.hand in motion.names:
        index = motion.names.index(track.hand)
        text += other_axis(motion, [index], track.up, lambda m, z: rise_in(m.times, z, cut))
    return (
        f"{text} (somebody who stands still is no lift: leave the file out; or is the unit "
        "another? --unit; smaller lifts: --rise)"
    )


def _taken(
    track: Track, lift: Lift, wishes: Wishes, trial: str, person: str, where: str
) -> tuple[Taken, int]:
    """Return a lift and the number of its filled samples."""
    motion = track.motion
    start, stop = lift.whole
    first, last = lift.span
    at = f"{where}: the lift from {first:.2f} s to {last:.2f} s"
    if cut_off(motion.times, track.heights, lift):
        raise InputError(
            f"{at} had begun before the first sample: leave it out with --leave-out, or read from "
            "a later time with --between"
        )
    if broken(motion.times, track.heights, lift):
        raise InputError(
            f"{at} begins or ends in a gap of more than a second in {track.hand}: leave it out "
            "with --leave-out, or choose a marker that was seen"
        )
    window = _seen_window(motion.times, track, start - TOLERANCE, stop + TOLERANCE)
    if track.far is not None and not _whole(motion.times, window, lift):
        raise InputError(
            f"{at}: the other end was not seen from its start to its end: choose another marker "
            "with --far, or leave the lift out with --leave-out"
        )
    times = motion.times[window]
    heights, far, count = track.heights[window], track.far, 0
    heights, count = filled(times, heights, wishes.fill)
    if far is not None:
        far, more = filled(times, far[window], wishes.fill)
        count += more
    for series, name in ((heights, track.hand), (far, "the other end")):
        if series is not None:
            _refuse_gap(series, name, track, window, at)
    if np.ptp(times) < SHORTEST:
        raise InputError(
            f"{at} lasts {np.ptp(times):.2f} s with its rest, must be at least {SHORTEST:g} s: a "
            "quick movement is no lift; leave it out with --leave-out, or raise --rise"
        )
    found = fault(times, heights)
    if found is not None:
        place = motion.where(window.start + found.sample)
        raise InputError(f"{at}, {place}: {found.text.replace('z_m', 'the height')}")
    return (
        Taken(
            trial=trial,
            person=person,
            times=times,
            heights=heights,
            phases=tuple(map(lift.phase_at, times.tolist())),
            far=far,
        ),
        count,
    )


def _seen_window(times: Series, track: Track, start: float, stop: float) -> slice:
    """Return the samples of a part, without unseen ones at its ends."""
    inside = (times >= start) & (times <= stop) & ~np.isnan(track.heights)
    if track.far is not None:
        inside &= ~np.isnan(track.far)
    seen = np.flatnonzero(inside)
    return slice(int(seen[0]), int(seen[-1]) + 1) if seen.size else slice(0, 0)


def _whole(times: Series, window: slice, lift: Lift) -> bool:
    """Return whether samples are those of a whole lift; of a recording uncut, whether any are."""
    start, stop = lift.span
    inside = np.flatnonzero((times >= start - TOLERANCE) & (times <= stop + TOLERANCE))
    needed = inside.tolist() if lift.phases else []
    return window.start < window.stop and all(window.start <= i < window.stop for i in needed)


def _refuse_gap(series: Series, name: str, track: Track, window: slice, at: str) -> None:
    motion = track.motion
    for gap in gaps_in(series):
        times = motion.times[window]
        length = gap.seconds(times)
        count = gap.stop - gap.start
        written = f", written as {_numbers(track.numbers)}," if track.numbers else ""
        raise InputError(
            f"{at} has a gap of {length:.2f} s in {name}: {count} sample(s){written} from "
            f"{motion.where(window.start + gap.start)} on, at {times[gap.start]:.2f} s: fill it "
            f"with --fill {np.ceil(100.0 * (length - TOLERANCE)) / 100.0:.2f}, choose another "
            "marker, or leave the lift out with --leave-out"
        )


def _numbers(found: Sequence[float]) -> str:
    return " or ".join(f"{number:g}" for number in found)
