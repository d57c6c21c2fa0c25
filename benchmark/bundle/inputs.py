"""The hands of live lifts in a bundle: ``inputs.npz``."""

from collections.abc import Mapping, Sequence
from typing import Any, Final

import numpy as np
from colift.agents.humans import Cued, HandLog, Played
from colift.agents.humans.cued import KINDS
from colift.base.errors import InputError
from colift.benchmark.bundle.arrays import Arrays, dump_arrays, parse_arrays, take_array
from colift.benchmark.bundle.files import INPUTS
from colift.benchmark.episode.scenario import Scenario
from numpy.typing import NDArray

HANDS: Final = ("human", "far")
"""The two ends; there are arrays of the far one only if a person held it in every lift."""

_SCALARS: Final = ("offset", "delay")
_SERIES: Final[Mapping[str, str]] = {"times": "<f8", "heights": "<f8", "frames": "<i8"}

MOST_BYTES: Final = 2**28
"""Largest size of the arrays together [bytes]."""


def dump_inputs(scenarios: Sequence[Scenario]) -> bytes | None:
    """Return the hands of live lifts as a file; None if the scenarios are not live lifts.

    ``cue`` has the kind and the seed of each lift's cues; then come, for each hand, ``offset`` and
    ``delay`` [s] of each lift, the number ``samples`` of its samples, and their ``times`` [s],
    ``heights`` [m] and ``frames``, lift after lift.
    """
    played = [each.human for each in scenarios if isinstance(each.human, Played)]
    if not played or len(played) != len(scenarios):
        return None
    cues = [(KINDS.index(each.cue.kind), each.cue.seed) for each in played]
    arrays: dict[str, NDArray[Any]] = {"cue": np.array(cues, dtype="<i8")}
    logs: dict[str, list[HandLog]] = {"human": [each.log for each in played]}
    far = [each.far for each in played if each.far is not None]
    if len(far) == len(played):
        logs["far"] = far
    elif far:
        return None
    for hand, of_hand in logs.items():
        for name in _SCALARS:
            arrays[f"{hand}_{name}"] = np.array([getattr(log, name) for log in of_hand], "<f8")
        arrays[f"{hand}_samples"] = np.array([len(log.times) for log in of_hand], "<i8")
        for name, kind in _SERIES.items():
            series = [getattr(log, name) for log in of_hand]
            arrays[f"{hand}_{name}"] = np.concatenate(series).astype(kind)
    return dump_arrays(arrays)


def parse_inputs(data: bytes, lifts: int) -> list[Played]:
    """Return the hands of a file, lift by lift.

    Raises
    ------
    InputError
        If it is not such a file, or has another number of lifts.
    """
    arrays = parse_arrays(data, INPUTS, MOST_BYTES)
    cues = take_array(arrays, "cue", "<i8", (lifts, 2), INPUTS)
    logs = _logs(arrays, "human", lifts)
    far = _logs(arrays, "far", lifts) if "far_samples" in arrays else [None] * lifts
    if arrays:
        raise InputError(f"{INPUTS}: unknown array {next(iter(arrays))!r:.80}")
    if lifts and not (cues[:, 0].min() >= 0 and cues[:, 0].max() < len(KINDS)):
        raise InputError(f"{INPUTS}: a kind of cues must be from 0 to {len(KINDS) - 1}")
    if lifts and cues[:, 1].min() < 0:
        raise InputError(f"{INPUTS}: a seed of cues must not be negative")
    return [
        Played(cue=Cued(kind=KINDS[kind], seed=seed), log=log, far=other)
        for (kind, seed), log, other in zip(cues.tolist(), logs, far, strict=True)
    ]


def _logs(arrays: Arrays, hand: str, lifts: int) -> list[HandLog]:
    def taken(name: str, dtype: str, length: int) -> NDArray[Any]:
        return take_array(arrays, f"{hand}_{name}", dtype, (length,), INPUTS)

    scalars = [taken(name, "<f8", lifts).tolist() for name in _SCALARS]
    counts = taken("samples", "<i8", lifts).tolist()
    if min(counts, default=0) < 0:
        raise InputError(f"{INPUTS}: a number of samples must not be negative")
    total = sum(counts)
    series = [taken(name, kind, total) for name, kind in _SERIES.items()]
    found, begin = [], 0
    for offset, delay, count in zip(*scalars, counts, strict=True):
        times, heights, frames = (each[begin : begin + count] for each in series)
        begin += count
        try:
            found.append(
                HandLog(offset=offset, delay=delay, times=times, heights=heights, frames=frames)
            )
        except InputError as error:
            raise InputError(f"{INPUTS}: {error}") from None
    return found
