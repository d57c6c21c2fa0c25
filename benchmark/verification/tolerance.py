"""How far a log may be from its replay if it comes from another platform."""

from collections.abc import Mapping
from typing import Final

import numpy as np

from ..replay import Simulated
from ..trace import Trace
from .bits import Place

HEIGHT: Final = 1e-5
"""Tolerance of heights [m]: of each action of the human, and of the table's ends, rms.

A table in two pairs of hands forgets small differences. Noise of 1e-15 m on each of the human's
actions, more than last bits make, moves the ends by 1e-15 m rms; 1e-6 m of noise by 1e-6 m, and by
1e-5 m/s and 1e-3 N. The tolerances are ten times those of the latter."""

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
"""Relative tolerance of scores that are computed from one and the same trace."""

REFERENCES: Final = 0.01
"""Relative tolerance of the scores of references that another platform has played."""


def beyond_tolerance(logged: Trace, found: Simulated) -> Place | None:
    """Return the first step in which a log is too far from its replay, and how; None if nowhere."""
    with np.errstate(over="ignore"):  # A forged log may have any number.
        return _human(logged, found) or _series(logged, found.trace)


def _human(logged: Trace, found: Simulated) -> Place | None:
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
