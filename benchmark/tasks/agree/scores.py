"""Scores of hurdles: the table's distance from them, the time to pass them, and the leader."""

import math
from collections.abc import Sequence
from typing import Any, Final

import numpy as np
from colift.agents.agent import FRAME
from colift.benchmark.episode.metrics import FAILED_FRAME_MM
from colift.benchmark.tasks.agree.hurdles import Hurdle
from colift.benchmark.tasks.touch import held
from colift.robots.arithmetic import dot
from numpy.typing import NDArray

STAY: Final = 20
"""Frames for which the table has to be at a hurdle, 0.2 s: who only crosses it has not found it.
After this time a person takes a rest there as intended (:data:`.precedence.SERVED`)."""

PASSED: Final = 0.01
"""Root mean square distance of both ends from a hurdle within which the table passes it [m]."""

CROSSING: Final = 0.3
"""Time before a crossing over which the power of leading is averaged [s], as in Chackochan and
Sanguineti (2019)."""

Heights = NDArray[np.float64]


def passing(height: Any, near: Any, far: Any) -> Any:
    """Return the table's square distance from the height of a hurdle [m2]; both ends count."""
    return ((near - height) ** 2 + (far - height) ** 2) / 2


def distance(hurdle: Hurdle, near: Heights, far: Heights) -> Heights:
    r"""Return the table's distance from a hurdle in each stay of its window [m].

    .. math:: d_t = \sqrt{\frac1K \sum_{k=t}^{t+K-1}
        \tfrac12 \left( (Z_{1k} - h)^2 + (Z_{2k} - h)^2 \right)}

    with K = :data:`STAY`. Both ends count: the table as a whole has to be there.

    Parameters
    ----------
    hurdle
        Its height h and window.
    near, far
        Heights Z1 and Z2 of the ends [m], shape (T,).

    Returns
    -------
    array
        One number for each frame t that begins a stay in the window; none if it was too short.
    """
    window = slice(hurdle.start, hurdle.stop)
    squares = passing(hurdle.height, near[window], far[window])
    return np.sqrt(held(squares, STAY)) if len(squares) >= STAY else np.empty(0)


def missed_mm(hurdle: Hurdle | None, near: Heights, far: Heights) -> float:
    """Return the distance by which the table misses a hurdle: the least :func:`distance` [mm].

    NaN without a hurdle; :data:`.FAILED_FRAME_MM` if the lift ended before a stay was possible.
    """
    if hurdle is None:
        return math.nan
    ways = distance(hurdle, near, far)
    return 1000 * float(ways.min()) if len(ways) else FAILED_FRAME_MM


def agreement_rmse_mm(errors: Sequence[float], frames: int, horizon: int) -> float:
    r"""Return the root mean square of a lift's errors [mm], those that are NaN left out.

    Each of the frames that a failure cut off counts with :data:`.FAILED_FRAME_MM`, each other frame
    with the root mean square of the errors.
    """
    known = np.array([error for error in errors if not math.isnan(error)])
    square = float(dot(known, known)) / len(known) if len(known) else 0.0
    return math.sqrt((frames * square + (horizon - frames) * FAILED_FRAME_MM**2) / horizon)


def agreement_ms(hurdles: Sequence[Hurdle | None], near: Heights, far: Heights) -> float:
    """Return the time from the opening of the first window until the last hurdle is passed [ms].

    A hurdle counts as passed at the end of the first stay within :data:`PASSED`, or at the end of
    its window if there is none. NaN without hurdles.
    """
    given = [hurdle for hurdle in hurdles if hurdle is not None]
    if not given:
        return math.nan
    passed = []
    for hurdle in given:
        there = np.flatnonzero(distance(hurdle, near, far) <= PASSED)
        passed.append(hurdle.start + int(there[0]) + STAY if there.size else hurdle.stop)
    return 1000 * FRAME * (max(passed) - min(hurdle.start for hurdle in given))


def leading_mw(hurdle: Hurdle | None, own: Heights, power: Heights, other: Heights) -> float:
    """Return the power with which the holder of an end leads the other to its own hurdle.

    The leadership index is a hand's mean power in the 0.3 s before its end crosses its own hurdle
    (Chackochan and Sanguineti 2019); here the other hands' mean power in the same time is
    subtracted, so that the power that accelerates the table drops out.

    Parameters
    ----------
    hurdle
        The hurdle of that end.
    own
        Height of that end [m], shape (T,).
    power, other
        Power of its hands and of those at the other end [W], shape (T,).

    Returns
    -------
    float
        Power [mW], positive for a leader; NaN if there is no hurdle or it is not crossed in its
        window.
    """
    if hurdle is None:
        return math.nan
    side = own[hurdle.start : hurdle.stop] > hurdle.height
    crossed = np.flatnonzero(side[1:] != side[:-1])
    if not crossed.size:
        return math.nan
    frame = hurdle.start + int(crossed[0]) + 1
    before = slice(max(frame - round(CROSSING / FRAME), 0), frame)
    return 1000 * float((power[before] - other[before]).mean())
