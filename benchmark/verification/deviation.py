"""Differences of a log from its replay: in any bit, or beyond the tolerance for other platforms."""

from collections.abc import Mapping
from typing import Final

import numpy as np
from colift.benchmark.episode.replay import Simulated
from colift.benchmark.episode.trace import Trace
from numpy.typing import NDArray

Place = tuple[int, str]
"""A step, and a message about the difference there."""

HEIGHT: Final = 1e-5
"""Tolerance of heights [m]: of each action of the human, and of the table's ends, rms.

A table in two pairs of hands damps small differences. Noise of 1e-15 m on each of the human's
actions, more than a difference in the last bits, moves the ends by 1e-15 m rms; noise of 1e-6 m
moves them by 1e-6 m, with 1e-5 m/s and 1e-3 N. The tolerances are ten times the latter values."""

TOLERANCES: Final[Mapping[str, tuple[float, str]]] = {
    "target": (HEIGHT, "m"),
    "human_end": (HEIGHT, "m"),
    "robot_end": (HEIGHT, "m"),
    "human_velocity": (10 * HEIGHT, "m/s"),
    "human_force": (1000 * HEIGHT, "N"),
    "robot_force": (1000 * HEIGHT, "N"),
}
"""Tolerance of each series of a trace, root mean square over the episode, and its unit."""

SCORES: Final = 1e-6
"""Relative tolerance of scores that are computed from the same trace."""

REFERENCES: Final = 0.01
"""Relative tolerance of the scores of baselines that another platform has played."""


def first_difference(logged: Trace, found: Simulated) -> Place | None:
    """Return the first step in which a log differs from its replay, and the difference, or None.

    Within a step the human's action is compared first, since the rest follows from it. Both have
    the same number of steps.
    """
    differing = [
        _human_bits(logged, found),
        *_frames(logged, found.trace),
        _state_hash(logged, found.trace),
    ]
    return min((each for each in differing if each), key=lambda each: each[0], default=None)


def _human_bits(logged: Trace, found: Simulated) -> Place | None:
    unequal = _unequal(logged.human_action, found.scripted)
    if not unequal.any():
        return None
    step, number = np.argwhere(unequal)[0].tolist()
    there, here = logged.human_action[step, number], found.scripted[step, number]
    return step, (
        "the human's action is not the scripted human's, given what it sees: "
        f"number {number} is {there}, would be {here}"
    )


def _frames(logged: Trace, true: Trace) -> list[Place]:
    per_step = logged.human_action.shape[1]
    places = []
    claimed = logged.by_frame()
    if claimed.keys() != true.by_frame().keys():
        return [(0, f"the series are {', '.join(claimed)}; must be {', '.join(true.by_frame())}")]
    for name, here in true.by_frame().items():
        there = claimed[name]
        unequal = _unequal(there, here)
        if unequal.any():
            frame = int(unequal.argmax())
            message = f"{name} in frame {frame} is {there[frame]}, the simulation gives "
            places.append((frame // per_step, f"{message}{here[frame]}"))
    return places


def _state_hash(logged: Trace, true: Trace) -> Place | None:
    unequal = (logged.state != true.state).any(axis=1)
    if not unequal.any():
        return None
    return int(unequal.argmax()), (
        "the hash of the actions and the state after them is not the logged one: an action of the "
        "robot's end, or the hash, has been changed"
    )


def _unequal(one: NDArray[np.float64], other: NDArray[np.float64]) -> NDArray[np.bool_]:
    """Return a mask of the places where two arrays differ in a bit: -0.0 is not 0.0."""
    bits = [np.ascontiguousarray(array, dtype="<f8").view(np.uint64) for array in (one, other)]
    unequal: NDArray[np.bool_] = bits[0] != bits[1]
    return unequal


def beyond_tolerance(logged: Trace, found: Simulated) -> Place | None:
    """Return the first step in which a log is too far from its replay, with the gap, or None."""
    with np.errstate(over="ignore"):  # A forged log may have any number.
        return _human_gap(logged, found) or _series(logged, found.trace)


def _human_gap(logged: Trace, found: Simulated) -> Place | None:
    gap = np.abs(logged.human_action - found.scripted).max(axis=1, initial=0.0)
    if not (gap > HEIGHT).any():
        return None
    step = int((gap > HEIGHT).argmax())
    return step, (
        f"the human's action is {gap[step]:.2g} m from the scripted human's, given what it sees; "
        f"{HEIGHT:.0e} m are tolerated from another platform"
    )


def _series(logged: Trace, true: Trace) -> Place | None:
    per_step = logged.human_action.shape[1]
    places = []
    for name, (tolerance, unit) in TOLERANCES.items():
        gap = np.abs(getattr(logged, name) - getattr(true, name))
        rms = float(np.sqrt(np.mean(gap**2))) if len(gap) else 0.0
        if rms > tolerance:
            message = (
                f"{name} is {rms:.2g} {unit} rms from the simulation; "
                f"{tolerance:.0e} {unit} are tolerated from another platform"
            )
            places.append((int((gap > tolerance).argmax()) // per_step, message))
    return min(places, key=lambda place: place[0], default=None)
