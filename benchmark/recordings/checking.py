"""Checks of a motion before it is cut: its clock, its rate, its unit."""

from dataclasses import replace
from typing import Final

import numpy as np
from colift.agents.humans.artefacts import FARTHEST, FEWEST, HOLE, LARGEST, LOWEST_RATE
from colift.base.errors import InputError
from colift.benchmark.recordings.motion import LENGTHS, Motion, Series, zeros
from colift.benchmark.recordings.unseen import without_numbers

LONGEST_HOLE: Final = 60.0
"""Longest time without samples [s] that is a break of a recording, and not a clock that jumped."""

HIGHEST_RATE: Final = 5000.0
"""More samples per second than any motion capture has."""

UNITS: Final = (
    (200.0, "milliseconds", "ms"),
    (2e5, "microseconds", "us"),
    (np.inf, "nanoseconds", "ns"),
)
"""Largest interval of motion capture in a unit, its name and its symbol."""


def check_stated_unit(motion: Motion, where: str) -> None:
    """Refuse a motion in a unit that is none of length.

    Raises
    ------
    InputError
        If the file states such a unit.
    """
    if motion.unit and motion.unit not in LENGTHS:
        raise InputError(
            f"{where}: the unit of length is {motion.unit!r:.40}, must be one of "
            f"{', '.join(LENGTHS)}: name it with --unit"
        )


def check_clock(motion: Motion, where: str) -> None:
    """Refuse a motion without a clock, or with one that stands still, jumps or has another unit.

    Raises
    ------
    InputError
        At the first such sample, with the option that helps.
    """
    if len(motion.times) < FEWEST:
        raise InputError(
            f"{where}: {len(motion.times)} samples, needs at least {FEWEST} (a lift at 10 Hz)"
        )
    if not motion.clocked:
        raise InputError(
            f"{where}: {motion.kind} without times: say how many frames there are per second, "
            "--rate HZ"
        )
    times = motion.times
    if not np.isfinite(times).all():
        sample = int((~np.isfinite(times)).argmax())
        raise InputError(
            f"{where}, {motion.where(sample)}: no time: correct it, or count samples by --rate HZ"
        )
    steps = np.diff(times)
    _check_order(motion, steps, where)
    _check_rate(motion, float(np.median(steps)), where)
    longest = int(steps.argmax())
    if steps[longest] > LONGEST_HOLE:
        raise InputError(
            f"{where}, {motion.where(longest + 1)}: no sample for {steps[longest]:g} s, from "
            f"{_since(motion, longest)} s on: a clock that jumped, or two recordings in one file; "
            f"{_read_before(motion, longest, 'or ')}correct the times"
        )


def _since(motion: Motion, sample: int) -> str:
    """Return the time of a sample from the first one [s], as exactly as ``--between`` takes it."""
    return f"{motion.times[sample] - motion.times[0]:.6f}".rstrip("0").rstrip(".")


def _read_before(motion: Motion, sample: int, then: str = "") -> str:
    """Return the advice to read the samples up to one, and a word; empty if they are too few."""
    if sample + 1 < FEWEST:
        return ""
    return f"read the part before it with --between 0:{_since(motion, sample)}, {then}"


def _check_order(motion: Motion, steps: Series, where: str) -> None:
    wrong = steps <= 0.0
    if not wrong.any():
        return
    i = int(wrong.argmax())
    at = f"{where}, {motion.where(i + 1)}: time"
    if steps[i] < 0.0:
        raise InputError(
            f"{at} goes back by {-steps[i]:g} s, {_since(motion, i)} s after the first sample: a "
            "clock that was set back, or two takes or markers one after the other; "
            f"{_read_before(motion, i)}name each take in a column 'trial', or count samples by "
            "--rate HZ"
        )
    span = motion.times[-1] - motion.times[0]
    likely = f" ({(len(steps)) / span:.4g}?)" if span > 0.0 else ""
    raise InputError(
        f"{at} stands still, at {_since(motion, i)} s after the first sample: rounded times: count "
        f"samples by --rate HZ{likely}; or two takes or markers under one name: name each in a "
        "column 'trial' or 'marker'"
    )


def _check_rate(motion: Motion, interval: float, where: str) -> None:
    at = f"{where}: a sample every {interval:g} s"
    if interval < 1.0 / HIGHEST_RATE:
        raise InputError(
            f"{at}, must be at most {HIGHEST_RATE:g} per second: are the times in another unit? "
            "Say --time-unit, or count samples by --rate HZ"
        )
    if interval * LOWEST_RATE <= 1.001:
        return
    raw = interval / motion.second
    if raw == 1.0:
        cure = "are these the numbers of frames? Say how many there are per second, --rate HZ"
    elif raw < 2.0:
        cure = "record it faster"
    else:
        name, symbol = next((name, symbol) for most, name, symbol in UNITS if raw < most)
        cure = f"are these {name}? --time-unit {symbol}; or numbers of frames? --rate HZ"
    raise InputError(f"{at}, needs {LOWEST_RATE:g} per second: {cure}")


def with_gaps(motion: Motion) -> Motion:
    """Return a motion with unseen samples where some are missing, as many as fit in.

    An interval is a gap by the rule of :data:`.artefacts.HOLE`.
    """
    steps = np.diff(motion.times)
    usual = float(np.median(steps))
    least, factor, most = HOLE
    limit = min(max(least, factor * float(np.quantile(steps, 0.95))), most)
    counts = np.where(steps > limit, np.rint(steps / usual).astype(int) - 1, 0)
    if not counts.any():
        return motion
    index = np.repeat(np.arange(len(steps)), counts)
    place = np.concatenate([np.arange(1, count + 1) for count in counts if count])
    added = motion.times[index] + place * (steps / (counts + 1))[index]
    order = np.argsort(np.concatenate((motion.times, added)), kind="stable")
    unseen = np.full((len(added), *motion.positions.shape[1:]), np.nan)
    return replace(
        motion,
        times=np.concatenate((motion.times, added))[order],
        positions=np.concatenate((motion.positions, unseen))[order],
        places=np.concatenate((motion.places, motion.places[index]))[order],
    )


def check_unit(motion: Motion, up: str, where: str) -> None:
    """Refuse heights that are not those of a hand in a room.

    Raises
    ------
    InputError
        If they are far from the origin or spread far, with the options that help.
    """
    unseen = zeros(motion)
    series = [
        without_numbers(np.where(unseen[:, i], np.nan, motion.heights(i, up)), motion.metre)[0]
        for i in range(len(motion.names))
    ]
    values = np.concatenate(series)
    values = values[np.isfinite(values)]
    if not values.size:
        raise InputError(f"{where}: no point was seen along {up}: export the positions again")
    low, typical, high = np.quantile(values, (0.05, 0.5, 0.95)).tolist()
    if abs(typical) <= FARTHEST and high - low <= LARGEST:
        return
    stated = f"in {motion.unit}, as the file says" if motion.unit else "in metres"
    raise InputError(
        f"{where}: read {stated}, heights along {up} are about {typical:.4g} m and span "
        f"{high - low:.3g} m, must be within {FARTHEST:g} m of the origin and span at most "
        f"{LARGEST:g} m: say the unit, --unit mm or cm; or another axis, --up; in a picture, whose "
        "Y points down, --unit METRES_PER_PIXEL --up -Y"
    )
