"""The axis that points up: told, stated, or only common, and then checked against the motion."""

from typing import Final

import numpy as np
from colift.base.errors import InputError
from colift.benchmark.recordings.choosing import Rises, Track, heights_of
from colift.benchmark.recordings.motion import Motion, zeros

UPRIGHT: Final = 1.5
"""A person's points spread by this factor further along the vertical than along another axis, if
they are measured from head to foot."""

BODY: Final = 12
"""Fewest points that are taken for a whole person, with the spread :data:`TALL`."""

TALL: Final = 1.1
"""[m]"""

CLEARLY: Final = 2.0
"""A hand that rises by this factor more along another axis makes an axis doubtful."""


def up_of(motion: Motion, told: str | None, where: str) -> str:
    """Return the axis that points up: as told, else as the file or its format has it.

    Raises
    ------
    InputError
        If neither tells it, and a person would lie along this axis.
    """
    if told is not None:
        return told
    if not motion.up_source and len(motion.names) >= BODY:
        other = "Y" if motion.up == "Z" else "Z"
        here, there = (_spread(motion, axis) for axis in (motion.up, other))
        if there > max(TALL, UPRIGHT * here):
            raise InputError(
                f"{where}: which axis points up? {motion.up} is usual for {motion.kind}, but the "
                f"points spread {there:.2f} m along {other} and {here:.2f} m along {motion.up}: "
                f"say --up {other}, or --up {motion.up}"
            )
    return motion.up


def _spread(motion: Motion, axis: str) -> float:
    """Return how far the points lie apart along an axis [m], by their middle places."""
    unseen = zeros(motion)
    places = [
        np.median(heights[seen])
        for i in range(len(motion.names))
        if (seen := np.isfinite(heights := motion.heights(i, axis)) & ~unseen[:, i]).any()
    ]
    return float(np.ptp(places)) if places else 0.0


def check_up(track: Track, rise: Rises, where: str) -> None:
    """Refuse a common axis for one that nobody stated, if the hand rises far more along another.

    Raises
    ------
    InputError
        With both axes.
    """
    motion, up = track.motion, track.up
    if motion.up_source or track.hand not in motion.names:
        return
    other = "Y" if up == "Z" else "Z"
    point = motion.names.index(track.hand)
    here, there = rise(motion, track.heights), rise(motion, heights_of(motion, [point], other)[0])
    if there > CLEARLY * here > 0.0:
        raise InputError(
            f"{where}: which axis points up? {track.hand} rises {here:.2f} m along {up}, which is "
            f"usual for {motion.kind}, and {there:.2f} m along {other}: say --up {other}, or --up "
            f"{up}"
        )
