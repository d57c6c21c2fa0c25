"""Where a log and its replay differ in any bit."""

import numpy as np
from numpy.typing import NDArray

from ..replay import Simulated
from ..trace import Trace

Place = tuple[int, str]
"""A step, and what is wrong there."""

BY_FRAME = tuple(name for name in Trace.series() if name not in ("action", "human_action"))
"""The series of a trace that have a number a frame."""


def first_difference(logged: Trace, found: Simulated) -> Place | None:
    """Return the first step in which a log differs from its replay, and how; None if in no bit.

    The human's action comes first within a step, for the rest follows from it. Both are of equally
    many steps.
    """
    differing = [_human(logged, found), *_frames(logged, found.trace), _state(logged, found.trace)]
    return min((each for each in differing if each), key=lambda each: each[0], default=None)


def _human(logged: Trace, found: Simulated) -> Place | None:
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
    for name in BY_FRAME:
        there, here = getattr(logged, name), getattr(true, name)
        unequal = _unequal(there, here)
        if unequal.any():
            frame = int(unequal.argmax())
            message = f"{name} in frame {frame} is {there[frame]}, the simulation gives "
            places.append((frame // per_step, f"{message}{here[frame]}"))
    return places


def _state(logged: Trace, true: Trace) -> Place | None:
    unequal = (logged.state != true.state).any(axis=1)
    if not unequal.any():
        return None
    return int(unequal.argmax()), (
        "the hash of the actions and the state after them is not the logged one: an action of the "
        "robot's end, or the hash, has been changed"
    )


def _unequal(one: NDArray[np.float64], other: NDArray[np.float64]) -> NDArray[np.bool_]:
    """Return where two arrays differ in a bit: -0.0 is not 0.0."""
    bits = [np.ascontiguousarray(array, dtype="<f8").view(np.uint64) for array in (one, other)]
    unequal: NDArray[np.bool_] = bits[0] != bits[1]
    return unequal
