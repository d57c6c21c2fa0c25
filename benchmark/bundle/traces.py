"""``traces.npz``: the traces of all episodes, joined end to end."""

import itertools
import math
import re
from collections.abc import Callable, Iterable, Iterator, Sequence
from functools import partial
from operator import attrgetter
from typing import Any, Final

import numpy as np
from colift.base.errors import InputError
from colift.benchmark.bundle.arrays import Arrays, Parts, take_array
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


def trace_arrays(
    traces: Callable[[], Iterable[Trace]], indices: Sequence[int]
) -> Iterator[tuple[str, Parts]]:
    """Yield the arrays of the traces by name.

    ``places``, ``frames`` and ``steps`` (k,) are each episode's place in the suite, counted from 0,
    and its numbers of frames and steps. They are followed by the series of :class:`.Trace`;
    ``task/NAME``, the series that the task adds; ``state``; and ``internals/NAME``, the policy's
    internals, NaN where it reports none. Internals whose names have characters other than letters,
    digits and ``_.-`` are left out.

    ``traces`` begins the traces anew for each array: they may be more than memory holds.
    """
    frames: list[int] = []
    steps: list[int] = []
    said: set[str] = set()
    one = next(iter(traces()))
    for trace in traces():
        frames.append(len(trace.human_end))
        steps.append(len(trace.action))
        said |= trace.internals.keys()
    for name, counts in (("places", indices), ("frames", frames), ("steps", steps)):
        yield name, Parts(dtype="<i8", shape=(len(counts),), parts=[np.array(counts)])

    def joined(rows: Sequence[int], series: Callable[[Trace], NDArray[Any]]) -> Parts:
        like = series(one)
        kind = "<f8" if like.dtype.kind == "f" else like.dtype.str
        parts = (series(trace) for trace in traces())
        return Parts(dtype=kind, shape=(sum(rows), *like.shape[1:]), parts=parts)

    for name in Trace.series():
        yield name, joined(steps if name in BY_STEP else frames, attrgetter(name))
    for name in one.added:
        yield ADDED + name, joined(frames, partial(_added, name))
    yield "state", joined(steps, attrgetter("state"))
    for name in [name for name in sorted(said) if _PLAIN_NAME.fullmatch(name)][:MOST_INTERNALS]:
        yield INTERNALS + name, joined(steps, partial(_reported, name))


def _added(name: str, trace: Trace) -> NDArray[np.float64]:
    return trace.added[name]


def _reported(name: str, trace: Trace) -> NDArray[np.float64]:
    """Return an internal of the policy, in which all 2^53 NaNs are the same one."""
    values = trace.internals.get(name)
    if values is None:
        return np.full(len(trace.action), math.nan)
    return np.where(np.isnan(values), math.nan, values)


def parse_traces(arrays: Arrays) -> tuple[tuple[Trace, ...], tuple[int, ...]]:
    """Return the traces, and their places in the suite.

    Raises
    ------
    InputError
        If an array is missing, superfluous, of the wrong type or shape, or not finite.
    """
    arrays = dict(arrays)
    indices, frames, steps = (_counts(arrays, name) for name in ("places", "frames", "steps"))
    episodes = len(indices)
    if not episodes or len(frames) != episodes or len(steps) != episodes:
        raise InputError(f"{TRACES}: places, frames and steps must have one number per episode")
    if any(b <= a for a, b in itertools.pairwise(indices)):
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
    return tuple(traces), indices


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
