"""The choice of the hand among the points of a motion, and of the axis that points up."""

import re
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Final

import numpy as np
from colift.base.errors import InputError
from colift.base.near_names import did_you_mean
from colift.benchmark.recordings.motion import Motion, Series, zeros
from colift.benchmark.recordings.unseen import without_numbers

HAND: Final = re.compile(
    r"hand|wrist|palm|finger|knuckle|thumb|fist|grip|hnd|fin\d?$|wr[ab]?$|tcp|(^|[^a-z])ee$",
    re.IGNORECASE,
)
"""Names of points of a hand, or of what moves with it."""

ALIKE: Final = 0.1
"""Points move alike if their heights differ from a constant by at most this share of their rise
(largest deviation): the two ends of a table that is lifted level, or markers of one hand."""

MOST_NAMES: Final = 12
"""Most names in a message."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Track:
    """The height of the hand over time, as it was measured."""

    motion: Motion
    hand: str
    """The point, or several points whose middle is taken, such as ``RWRA+RWRB``."""
    up: str
    """The axis that points up, such as ``Z``, or ``-Y``."""
    heights: Series
    """[m], shape (n,); NaN where it was not seen."""
    far: Series | None = None
    """Height of the other end [m], shape (n,), if it was chosen."""
    numbers: tuple[float, ...] = ()
    """The numbers that stand for no value, in the unit of the file."""
    why: str = ""
    """The reason for the choice, if nobody made it; the beginning of a sentence's end."""


Rises = Callable[[Motion, Series], float]
"""How far the hand rises in the lifts of a series of heights [m]; 0 without any."""


def choose(
    motion: Motion, hand: str | None, far: str | None, up: str, rise: Rises, where: str
) -> Track:
    """Return the height of the hand.

    Without a choice it is the only point; or the point that the file calls the hand; or, of the
    points of hands by their names (of all points, if there are none), one that rises, if all that
    rise move alike: the most complete one, and the first of these.

    Parameters
    ----------
    motion
        The points.
    hand, far
        The points that were chosen; None if none was.
    up
        The axis that points up.
    rise
        How far a point rises in lifts.
    where
        The file's name, for messages.

    Raises
    ------
    InputError
        If a point is not there, or the choice is open.
    """
    chosen, why = (hand, "") if hand is not None else _open_choice(motion, up, rise, where)
    points = _indices(motion, chosen, "--marker", where)
    heights, numbers = heights_of(motion, points, up)
    other = None
    if far is not None:
        other, more = heights_of(motion, _indices(motion, far, "--far", where), up)
        numbers = tuple(dict.fromkeys((*numbers, *more)))
    return Track(
        motion=motion,
        hand="+".join(motion.names[i] for i in points),
        up=up,
        heights=heights,
        far=other,
        numbers=numbers,
        why=why,
    )


def heights_of(motion: Motion, points: Sequence[int], up: str) -> tuple[Series, tuple[float, ...]]:
    """Return the mean height of some points, NaN where one was not seen, and numbers for that."""
    unseen = zeros(motion)
    sign = -1.0 if up.startswith("-") else 1.0
    found = [
        without_numbers(np.where(unseen[:, i], np.nan, motion.heights(i, up)), sign * motion.metre)
        for i in points
    ]
    numbers = dict.fromkeys(number for _, several in found for number in several)
    zero = {0.0: None} if unseen[:, points].any() else {}
    return np.mean([series for series, _ in found], axis=0), tuple(zero | numbers)


def _indices(motion: Motion, chosen: str, option: str, where: str) -> list[int]:
    """Return the points of a choice: one, or several with plus signs between them."""
    whole = _matching(motion.names, chosen)
    found = []
    for part in [chosen] if whole else chosen.split("+"):
        indices = _matching(motion.names, part.strip())
        if len(indices) > 1:
            several = ", ".join(motion.names[i] for i in indices[:MOST_NAMES])
            raise InputError(f"{where}: {option} {part!r:.60} may be {several}: name one in full")
        if not indices:
            meant = did_you_mean(part, map(_bare, motion.names))
            raise InputError(
                f"{where}: {option} {part!r:.60} is not there: {meant}the file has "
                f"{_listed(motion.names)}"
            )
        found += indices
    return found


def _matching(names: Sequence[str], text: str) -> list[int]:
    """Return the points of a name: exactly, else in any case, else without their subjects."""
    for form in (str, str.casefold, _bare):
        found = [i for i, name in enumerate(names) if form(name) == form(text)]
        if found:
            return found
    return []


def _bare(name: str) -> str:
    """Return a name without the subject or the path before it, in lower case."""
    return re.split(r"[:/|]", name)[-1].strip().casefold()


def _listed(names: Sequence[str]) -> str:
    shown = ", ".join(name[:40] for name in names[:MOST_NAMES])
    return shown + (f" and {len(names) - MOST_NAMES} more" if len(names) > MOST_NAMES else "")


def _open_choice(motion: Motion, up: str, rise: Rises, where: str) -> tuple[str, str]:
    """Return a point that nobody has chosen, and the reason."""
    names = motion.names
    if len(names) == 1:
        return names[0], ""
    if motion.hand:
        return motion.hand, ""
    hands = [i for i, name in enumerate(names) if HAND.search(_bare(name))]
    candidates = hands or [*range(len(names))]
    series = {i: heights_of(motion, [i], up)[0] for i in candidates}
    rises = {i: rise(motion, heights) for i, heights in series.items()}
    moving = {i: series[i] for i in candidates if rises[i] > 0.0}
    if not moving:
        raise InputError(
            f"{where}: none of its {'hands' if hands else 'points'} rises along {up}"
            f"{other_axis(motion, candidates, up, rise)}: name the hand's marker, --marker NAME "
            f"(it has {_listed(names)}), or the axis that points up, --up X, Y, Z or -Y; somebody "
            "who stands still is no lift: leave the file out"
        )
    best = min(moving, key=lambda i: (int(np.isnan(moving[i]).sum()), i))
    differing = [i for i, heights in moving.items() if not _alike(heights, moving[best])]
    if differing:
        shown = sorted(moving, key=lambda i: -rises[i])[:MOST_NAMES]
        listed = ", ".join(f"{names[i]} ({rises[i]:.2f} m)" for i in shown)
        raise InputError(
            f"{where}: which point is the hand? {len(moving)} of {len(names)} rise, and not alike: "
            f"{listed}{' and more' if len(moving) > len(shown) else ''}: choose one with --marker "
            f"{names[shown[0]]!r}, or the middle of several, --marker 'A+B'"
        )
    if len(moving) == 1:
        return names[
            best
        ], f"the only one of {len(names)} {'of a hand ' if hands else ''}that rises"
    return names[best], f"the most complete of {len(moving)} that rise alike"


def other_axis(motion: Motion, candidates: Sequence[int], up: str, rise: Rises) -> str:
    """Return along which other axis one of some points rises the most, in words; empty if none."""
    risen = {
        axis: max(rise(motion, heights_of(motion, [i], axis)[0]) for i in candidates)
        for axis in ("Y", "Z", "X", "-Y", "-Z", "-X")
        if axis != up
    }
    best = max(risen, key=lambda axis: risen[axis])
    return f", but {risen[best]:.2f} m along {best} (--up {best}?)" if risen[best] > 0.0 else ""


def _alike(one: Series, other: Series) -> bool:
    difference = one - other
    both = np.isfinite(difference)
    if both.sum() < 2:
        return False
    apart = float(np.ptp(difference[both]))
    return apart <= ALIKE * float(np.ptp(other[both]))
