"""Artefacts of measurement in a recording, which would be played as movements of a person.

Each limit lies between people and artefacts. Measured were the 46 wrists of two people in HDM05
(M. Mueller et al., "Documentation Mocap Database HDM05", CG-2007-2, Universitaet Bonn), 12 fists of
a pair in front of a depth camera, one lift sampled at 15 to 1000 Hz, irregularly, and in steps of
1 cm; and the same lift with the artefacts of motion capture that are reported in public.

=================== =========================================== ================================
limit               people                                      artefacts
=================== =========================================== ================================
:data:`FASTEST`     0.9 to 3.1 m/s                              90 m/s and more
:data:`LOWEST_RATE` 15 Hz and more                              1 Hz and less
:data:`HOLE`        the longest interval; 0.43 s if irregular   1.8 s and more
:data:`LARGEST`     0.24 to 1.06 m                              96 and more, in other units
:data:`STILL`       0.24 to 1.06 m                              0.012 m of sway
:data:`SLOWEST`     1.3 to 4.3 times slower                     9 to 25 times
=================== =========================================== ================================
"""

from collections.abc import Callable, Iterable
from typing import Final, NamedTuple

import numpy as np
from colift.agents.humans.recordings import LEAST_MOVEMENT, LONGEST, Recording
from colift.agents.humans.shape import shape_of
from numpy.typing import NDArray

FASTEST: Final = 10.0
"""Highest speed of a hand between two samples [m/s]."""

STEP: Final = 0.05
"""Largest step between two samples [m] that is no jump, however close they are."""

FEWEST: Final = 10
"""Fewest samples of a lift."""

SHORTEST: Final = 0.5
"""Shortest duration [s]; the shortest in HDM05 lasts 1.1 s."""

LOWEST_RATE: Final = 10.0
"""Fewest samples per second, by the median of their intervals."""

HOLE: Final = (0.2, 10.0, 0.5)
"""An interval is a hole above the first time [s] if it is above the second number times nearly all
(95 %) of the intervals; above the third time [s] in any case."""

LARGEST: Final = 3.0
"""Largest range of heights [m]."""

FARTHEST: Final = 10.0
"""Largest typical distance of a hand from the origin of the heights [m]."""

STILL: Final = 0.03
"""Smallest range of heights of a lift [m]; who stands still sways by less."""

SLOWEST: Final = 8.0
"""Largest factor by which a lift may have to be slowed down: its highest speed would otherwise be
out of proportion to its height."""

UNSEEN: Final = (0.0, *(sign * (10.0**n - 1.0) for n in range(2, 7) for sign in (1.0, -1.0)))
"""Heights that are written for a marker that was not seen: 0, 99, -99, 999, -999 and so on."""

CUT: Final = "fill the gap, or cut the lift there"

Series = NDArray[np.float64]


class Fault(NamedTuple):
    """An artefact: the sample at which it shows, and a description with its cure."""

    sample: int
    text: str


Check = Callable[[Series, Series], Fault | None]
"""A check of times [s] and heights [m], each of shape (n,)."""


def fault(times: Series, heights: Series) -> Fault | None:
    """Return the first artefact in the samples of a lift; None if there is none.

    Parameters
    ----------
    times
        Time of each sample [s], shape (n,).
    heights
        Height at each time [m], shape (n,); NaN where it was not seen.
    """
    return first_fault(CHECKS, times, heights)


def first_fault(checks: Iterable[Check], times: Series, heights: Series) -> Fault | None:
    """Return the first artefact that some checks find; None if they find none."""
    with np.errstate(over="ignore", invalid="ignore"):  # Numbers near the largest are refused, too.
        return next(filter(None, (check(times, heights) for check in checks)), None)


def gap(times: Series, values: Series, column: str) -> Fault | None:
    """Return the first gap in the values of a column, NaN where there is none; None without one."""
    unseen = np.isnan(values)
    if not unseen.any():
        return None
    first = int(unseen.argmax())
    length = int((~unseen[first:]).argmax()) or len(unseen) - first
    many = "1 sample" if length == 1 else f"{length} samples"
    return Fault(
        first,
        f"{column} is nan or empty in {many}, {times[first]:g} s to "
        f"{times[first + length - 1]:g} s, must be a finite number (a marker that was not seen? "
        f"{CUT})",
    )


def _gap_in_heights(times: Series, heights: Series) -> Fault | None:
    return gap(times, heights, "z_m")


def _few(times: Series, heights: Series) -> Fault | None:
    if len(times) >= FEWEST:
        return None
    return Fault(0, f"has {len(times)} sample(s), needs at least {FEWEST}")


def _disorder(times: Series, heights: Series) -> Fault | None:
    steps = np.diff(times)
    wrong = steps <= 0.0
    if not wrong.any():
        return None
    i = int(wrong.argmax())
    why = "a clock that was set back, or two markers or takes under one name: name each of its own"
    if steps[i] == 0.0:
        why = (
            "rounded times, or two markers under one name: write more digits, name each of its own"
        )
    return Fault(
        i + 1, f"time goes from {times[i]!s} s to {times[i + 1]!s} s, must increase ({why})"
    )


def _rate(times: Series, heights: Series) -> Fault | None:
    interval = float(np.median(np.diff(times)))
    if interval * LOWEST_RATE <= 1.001:
        return None
    if interval == 1.0:
        why = "frame numbers in t_s? divide them by the frame rate"
    elif interval < 2.0:
        why = "record it faster"
    else:
        unit = next(
            unit
            for most, unit in (
                (200.0, "milliseconds: divide by 1000; or frame numbers: by the frame rate"),
                (2e5, "microseconds: divide by 1e6"),
                (np.inf, "nanoseconds: divide by 1e9"),
            )
            if interval < most
        )
        why = f"is t_s in seconds? it looks like {unit}"
    return Fault(1, f"has a sample every {interval:g} s, needs {LOWEST_RATE:g} per second ({why})")


def _hole(times: Series, heights: Series) -> Fault | None:
    steps = np.diff(times)
    least, factor, most = HOLE
    limit = min(max(least, factor * float(np.quantile(steps, 0.95))), most)
    i = int((steps > limit).argmax())
    if steps[i] <= limit:
        return None
    return Fault(
        i + 1,
        f"no sample for {steps[i]:g} s, from {times[i]!s} s on, must be at most {limit:.2g} s "
        f"(missing rows: {CUT}; a clock that jumped: correct t_s; two takes under one name: name "
        "each of its own)",
    )


def _duration(times: Series, heights: Series) -> Fault | None:
    lasting = times[-1] - times[0]
    if SHORTEST <= lasting <= LONGEST:
        return None
    return Fault(
        len(times) - 1,
        f"lasts {lasting:g} s, must be from {SHORTEST:g} to {LONGEST:g} s (is t_s in seconds?)",
    )


def _unseen(times: Series, heights: Series) -> Fault | None:
    """Return a value for a marker that was not seen, away from all other heights."""
    for value in UNSEEN:
        there = heights == value
        if not there.any() or there.all():
            continue
        others = heights[~there]
        if np.abs(others - value).min() > max(STEP, 0.05 * float(np.ptp(others))):
            many = f"{int(there.sum())} of {len(heights)} samples"
            return Fault(
                int(there.argmax()),
                f"z_m is {value:g} in {many}, far from all others (written for a marker that was "
                f"not seen? {CUT})",
            )
    return None


def _units(times: Series, heights: Series) -> Fault | None:
    low, typical, high = np.quantile(heights, (0.05, 0.5, 0.95)).tolist()
    if abs(typical) <= FARTHEST and high - low <= LARGEST:
        return None
    return Fault(
        0,
        f"z_m is about {typical:g} and spans {high - low:.3g}, must be within {FARTHEST:g} m of "
        f"the origin and span at most {LARGEST:g} m (is z_m in metres? divide millimetres by 1000, "
        "centimetres by 100, pixels by those of a metre)",
    )


def _jump(times: Series, heights: Series) -> Fault | None:
    steps, sizes = np.diff(times), np.abs(np.diff(heights))
    jumps = sizes > np.maximum(FASTEST * steps, STEP)
    if not jumps.any():
        return None
    i = int(jumps.argmax())
    return Fault(
        i + 1,
        f"z_m goes from {heights[i]:g} m to {heights[i + 1]:g} m in {steps[i]:.3g} s, "
        f"{sizes[i] / steps[i]:.3g} m/s, must be at most {FASTEST:g} m/s (a marker that was lost "
        f"or exchanged: {CUT}; two takes under one name: name each of its own; is z_m in metres?)",
    )


def _range(times: Series, heights: Series) -> Fault | None:
    span = float(np.ptp(heights))
    if span > LARGEST:
        return Fault(
            int(np.abs(heights - np.median(heights)).argmax()),
            f"its heights span {span:g} m, must be at most {LARGEST:g} m (is z_m in metres?)",
        )
    return None


def _still(times: Series, heights: Series) -> Fault | None:
    span = float(np.ptp(heights))
    if span < STILL:
        return Fault(
            0,
            f"does not move: its heights span {span:.4f} m, must be at least {STILL} m (somebody "
            "who stands still is no lift: leave the trial out; is z_m in metres?)",
        )
    return None


def _proportion(times: Series, heights: Series) -> Fault | None:
    shape = shape_of(
        Recording(name="", times=tuple(times.tolist()), heights=tuple(heights.tolist()))
    )
    least = 0.5 * LEAST_MOVEMENT
    if shape.highest < least:
        return Fault(
            0,
            f"does not move: after smoothing it rises {shape.highest:.4f} m above its start, must "
            f"be at least {least} m",
        )
    if shape.slow_down <= SLOWEST:
        return None
    sample = int(np.searchsorted(times - times[0], shape.steepest_time))
    return Fault(
        min(sample, len(times) - 1),
        f"would be slowed down {shape.slow_down:.3g} times, must be at most {SLOWEST:g} times: its "
        "highest speed is out of proportion to its height (outliers, or the noise of somebody who "
        f"stands still: correct z_m near {times[0] + max(shape.steepest_time, 0.0):.2f} s, or "
        "leave the trial out)",
    )


OF_HEIGHTS: Final[tuple[Check, ...]] = (_unseen, _units, _jump, _range)
"""The checks of heights that need not be those of a lift; their times and gaps are checked."""

CHECKS: Final[tuple[Check, ...]] = (
    _disorder,
    _gap_in_heights,
    _few,
    _rate,
    _hole,
    _duration,
    *OF_HEIGHTS,
    _still,
    _proportion,
)
"""The checks in an order in which each may assume what the earlier ones found to be right."""
