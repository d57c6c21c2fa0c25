"""Artefacts in what was measured beside a lift: the other end, the table's tilt, the force."""

from collections.abc import Iterator
from typing import Final

import numpy as np
from colift.agents.humans.artefacts import OF_HEIGHTS, Fault, Series, first_fault, gap
from colift.agents.humans.recordings import FAR, FORCE, TILT

FARTHEST_APART: Final = 0.5
"""Largest mean height difference of the two ends [m]: half a metre is a table of 1.5 m at 20 deg,
and less than a hand's height above the floor."""

STEEPEST: Final = 45.0
"""Largest inclination of a table [deg]: things slide off it."""

FASTEST_TURN: Final = 500.0
"""Highest speed at which a table turns [deg/s]: with ends 0.5 m apart, 4 m/s of one of them."""

STRONGEST: Final = 500.0
"""Largest force at a hand [N]: a load of 50 kg, or a sensor in another unit."""

LENGTHS: Final = (0.2, 5.0)
"""Shortest and longest table [m]."""

AGREEING: Final = 0.02
"""Largest root mean square deviation [m] of the height difference from that of the inclination: an
inclinometer that is off by 1 deg is off by this on a table of 1.2 m."""


def beside_fault(times: Series, heights: Series, beside: dict[str, Series]) -> Fault | None:
    """Return the first artefact in the series beside a lift; None if there is none.

    Parameters
    ----------
    times, heights
        Time [s] and height [m] of each sample, shape (n,), without artefacts of their own.
    beside
        The series of :data:`.BESIDE` that the lift has, by their columns, each of shape (n,); NaN
        where there is no value.
    """
    for column, values in beside.items():
        found = gap(times, values, column)
        if found is not None:
            return found
    with np.errstate(over="ignore"):
        return next(_faults(times, heights, beside), None)


def _faults(times: Series, heights: Series, beside: dict[str, Series]) -> Iterator[Fault]:
    far, tilts, forces = (beside.get(column) for column in (FAR, TILT, FORCE))
    if far is not None:
        yield from _of_far_end(times, heights, far)
    if tilts is not None:
        yield from _of_tilt(times, tilts)
    if far is not None and tilts is not None:
        yield from contradiction(times, heights - far, tilts)
    if forces is not None:
        yield from _of_force(forces)


def _of_far_end(times: Series, heights: Series, far: Series) -> Iterator[Fault]:
    found = first_fault(OF_HEIGHTS, times, far)
    if found is not None:
        yield Fault(found.sample, found.text.replace("z_m", FAR))
    if np.array_equal(heights, far):
        yield Fault(
            0,
            f"{FAR} equals z_m in all samples (one marker in both columns? {FAR} is the height of "
            "the other person's end)",
        )
    apart = abs(float((heights - far).mean()))
    if apart > FARTHEST_APART:
        yield Fault(
            0,
            f"the two ends are {apart:.2f} m apart in height on average, must be at most "
            f"{FARTHEST_APART:g} m (z_m and {FAR} need the same origin, such as the floor)",
        )


def _of_tilt(times: Series, tilts: Series) -> Iterator[Fault]:
    steepest = int(np.abs(tilts).argmax())
    if abs(tilts[steepest]) > STEEPEST:
        yield Fault(
            steepest,
            f"{TILT} is {tilts[steepest]:g}, must be within {STEEPEST:g} deg of 0, a level table "
            "(another zero? written for a marker that was not seen?)",
        )
    turns = np.abs(np.diff(tilts)) > np.maximum(FASTEST_TURN * np.diff(times), 5.0)
    if turns.any():
        i = int(turns.argmax())
        yield Fault(
            i + 1,
            f"{TILT} goes from {tilts[i]:g} to {tilts[i + 1]:g} in {times[i + 1] - times[i]:.3g} s "
            "(a marker that was lost or exchanged?)",
        )


def contradiction(
    times: Series, differences: Series, tilts: Series, lengths: tuple[float, float] = LENGTHS
) -> Iterator[Fault]:
    """Yield a fault if no table has these height differences [m] at these inclinations [deg].

    ``lengths`` are the least and the greatest length of a table [m].
    """
    low, high = lengths
    sines = np.sin(np.radians(tilts))
    squares = float(sines @ sines)
    length = float(sines @ differences) / squares if squares > 0.0 else low
    apart = differences - min(max(length, low), high) * sines
    if np.sqrt(np.mean(apart**2)) > AGREEING:
        i = int(np.abs(apart).argmax())
        yield Fault(
            i,
            f"{FAR} and {TILT} contradict each other: at {times[i]:g} s, z_m is "
            f"{1000 * differences[i]:.0f} mm above {FAR} at {tilts[i]:.1f} deg, which no table of "
            f"{f'{low:g} m' if low == high else f'{low:g} to {high:g} m'} is at all times of the "
            "lift (positive: the end of z_m is the higher one; in degrees, not radians): correct "
            "one of the two columns, or leave it out",
        )


def _of_force(forces: Series) -> Iterator[Fault]:
    strongest = int(np.abs(forces).argmax())
    if abs(forces[strongest]) > STRONGEST:
        yield Fault(
            strongest,
            f"{FORCE} is {forces[strongest]:g}, must be within {STRONGEST:g} N (is it in newtons? "
            "an overloaded sensor?)",
        )
    if np.ptp(forces) == 0.0:
        yield Fault(0, f"{FORCE} is {forces[0]:g} in all samples (a sensor that was off?)")
