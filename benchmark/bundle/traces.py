"""``traces.npz``: the traces of all episodes, joined end to end."""

import itertools
import math
import re
from collections.abc import Sequence
from typing import Any, Final

import numpy as np
from colift.agents.errors import InputError
from colift.benchmark.bundle.arrays import Arrays, take_array
from colift.benchmark.bundle.files import TRACES
from colift.benchmark.episode.recorder import HASH_BYTES
from colift.benchmark.episode.trace import ADDED, BY_STEP, Trace
from numpy.typing import NDArray

INTERNALS: Final = "internals/"

_PLAIN_NAME: Final = re.compile(r"[A-Za-z0-9_][A-Za-z0-9_.-]{0,63}", re.ASCII)

_NAN: Final = np.array(math.nan, dtype="<f8").view("<u8")

MOST_INTERNALS: Final = 100
"""Largest number of internals that are kept."""

LARGEST_LIFT: Final = 2**24
"""Largest size of a lift's arrays [bytes]: 120 s with a decision every frame and the largest number
of internals take 11 MB."""


def dump_traces(traces: Sequence[Trace], places: Sequence[int]) -> Arrays:
    """Return the traces as arrays.

    ``places``, ``frames`` and ``steps`` (k,) are each episode's place in the suite, counted from 0,
    and its numbers of frames and steps. They are followed by the series of :class:`.Trace`;
    ``task/NAME``, the series that the task adds; ``state``; and ``internals/NAME``, the policy's
    internals, NaN where it reports none. Internals whose names have characters other than letters,
    digits and ``_.-`` are left out.
    """
    arrays: dict[str, NDArray[Any]] = {
        "places": np.array(places, dtype="<i8"),
        "frames": np.array([len(trace.human_end) for trace in traces], dtype="<i8"),
        "steps": np.array([len(trace.action) for trace in traces], dtype="<i8"),
    }
    for name in Trace.series():
        parts = [getattr(trace, name) for trace in traces]
        arrays[name] = np.concatenate(parts).astype("<f8")
    for name in traces[0].added:
        parts = [trace.added[name] for trace in traces]
        arrays[ADDED + name] = np.concatenate(parts).astype("<f8")
    arrays["state"] = np.concatenate([trace.state for trace in traces])
    said = sorted({name for trace in traces for name in trace.internals})
    for name in [name for name in said if _PLAIN_NAME.fullmatch(name)][:MOST_INTERNALS]:
        parts = [
            trace.internals.get(name, np.full(len(trace.action), math.nan)) for trace in traces
        ]
        values = np.concatenate(parts).astype("<f8")
        values[np.isnan(values)] = math.nan  # All 2^53 NaNs become the same one.
        arrays[INTERNALS + name] = values
    return arrays


def parse_traces(arrays: Arrays) -> tuple[tuple[Trace, ...], tuple[int, ...]]:
    """Return the traces, and their places in the suite.

    Raises
    ------
    InputError
        If an array is missing, superfluous, of the wrong type or shape, or not finite.
    """
    arrays = dict(arrays)
    places, frames, steps = (_counts(arrays, name) for name in ("places", "frames", "steps"))
    episodes = len(places)
    if not episodes or len(frames) != episodes or len(steps) != episodes:
        raise InputError(f"{TRACES}: places, frames and steps must have one number per episode")
    if any(b <= a for a, b in itertools.pairwise(places)):
        raise InputError(f"{TRACES}: places must increase")
    series = {
        name: _series(arrays, name, sum(steps) if name in BY_STEP else sum(frames))
        for name in Trace.series()
    }
    added = {
        name.removeprefix(ADDED): _series(arrays, name, sum(frames))
        for name in sorted(arrays)
        if name.startswith(ADDED)
    }
    per_step = series["human_action"].shape[1]
    for episode, (n, m) in enumerate(zip(frames, steps, strict=True)):
        if n != m * per_step:
            raise InputError(
                f"{TRACES}: episode {episode} has {n} frames in {m} steps, must be {m * per_step}"
            )
    state = take_array(arrays, "state", "|u1", (sum(steps), HASH_BYTES), TRACES)
    if len(arrays) > MOST_INTERNALS:
        raise InputError(f"{TRACES}: {len(arrays)} internals, at most {MOST_INTERNALS} are kept")
    internals = {name: _internal(arrays, name, sum(steps)) for name in sorted(arrays)}
    traces = []
    last_frame = last_step = 0
    for n, m in zip(frames, steps, strict=True):
        frame = slice(last_frame, last_frame + n)
        step = slice(last_step, last_step + m)
        last_frame, last_step = frame.stop, step.stop
        cut = {name: all_[step if name in BY_STEP else frame] for name, all_ in series.items()}
        said = {name.removeprefix(INTERNALS): all_[step] for name, all_ in internals.items()}
        own = {name: all_[frame] for name, all_ in added.items()}
        traces.append(Trace(**cut, state=state[step], added=own, internals=said))
    return tuple(traces), places


def _counts(arrays: Arrays, name: str) -> tuple[int, ...]:
    counts = tuple(take_array(arrays, name, "<i8", (None,), TRACES).tolist())
    if min(counts, default=0) < 0:
        raise InputError(f"{TRACES}: {name} must not be negative")
    return counts


def _series(arrays: Arrays, name: str, length: int) -> NDArray[np.float64]:
    shape = (None, None) if name in BY_STEP else (None,)
    array: NDArray[np.float64] = take_array(arrays, name, "<f8", shape, TRACES)
    if len(array) != length:
        raise InputError(f"{TRACES}: {name} has {len(array)} rows, must have {length}")
    if not np.isfinite(array).all():
        row = int(np.argwhere(~np.isfinite(array))[0][0])
        raise InputError(f"{TRACES}: {name} is not finite in row {row}")
    return array


def _internal(arrays: Arrays, name: str, length: int) -> NDArray[np.float64]:
    plain = name.startswith(INTERNALS) and _PLAIN_NAME.fullmatch(name.removeprefix(INTERNALS))
    if not plain:
        raise InputError(f"{TRACES}: {name!r:.80} is not an array of a bundle")
    array: NDArray[np.float64] = take_array(arrays, name, "<f8", (None,), TRACES)
    if len(array) != length:
        raise InputError(f"{TRACES}: {name} has {len(array)} rows, must have {length}")
    if (array.view("<u8")[np.isnan(array)] != _NAN).any():
        raise InputError(f"{TRACES}: {name} has a NaN that is not as colift writes it")
    return array
