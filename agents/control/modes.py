"""What a person is doing: resting, setting out, on the way, stopping, turning back."""

from typing import Final

import numpy as np
from numpy.typing import NDArray

from ..agent import FRAME

Array = NDArray[np.float64]

MODES: Final = ("rest", "onset", "stroke", "pause", "reversal")
"""What the velocities now and :data:`AHEAD` later say: still and still; still, then moving; moving
on; moving, then still; moving, then the other way."""

STILL: Final = 0.02
"""Speed below which a person is still [m/s]: a tenth of a lift's peak, four times a tremor's."""

AHEAD: Final = 0.3
"""How far the second look is ahead [s]: as far as what is done now reaches, the latency until it
is seen included."""

HALF: Final = 3
"""Half of the frames over which a velocity is taken, so that a tremor is no motion."""


def velocities(heights: Array) -> Array:
    """Return the velocity [m/s] in each frame, over :data:`HALF` frames before and after.

    Before the first frame and after the last the height stays.

    Parameters
    ----------
    heights
        (n,) height in each frame [m].
    """
    padded = np.pad(heights, HALF, mode="edge")
    velocity: Array = (padded[2 * HALF :] - padded[: -2 * HALF]) / (2 * HALF * FRAME)
    return velocity


def modes(heights: Array) -> Array:
    """Return which of the :data:`MODES` each frame of a lift is in, (n, 5) of ones and zeros.

    Parameters
    ----------
    heights
        (n,) height of the person's end in each frame [m]; the last stays.
    """
    now = velocities(heights)
    ahead = round(AHEAD / FRAME)
    then = np.concatenate((now[ahead:], np.zeros(min(ahead, len(now)))))
    moves, goes_on = np.abs(now) >= STILL, np.abs(then) >= STILL
    same = np.sign(now) == np.sign(then)
    found = (
        ~moves & ~goes_on,
        ~moves & goes_on,
        moves & goes_on & same,
        moves & ~goes_on,
        moves & goes_on & ~same,
    )
    return np.stack(found, axis=1).astype(np.float64)


def stroke_ends(heights: Array) -> Array:
    """Return where the stroke in progress will end [m], for each frame of a lift.

    A stroke ends in the first frame that is still or goes the other way. A frame that is still is
    an end itself.

    Parameters
    ----------
    heights
        (n,) height of the person's end in each frame [m]; the last stays.
    """
    velocity = velocities(heights)
    way = np.where(np.abs(velocity) >= STILL, np.sign(velocity), 0.0)
    changes = np.flatnonzero(np.diff(way)) + 1
    frames = np.arange(len(heights))
    following = np.append(changes, len(heights) - 1)
    ends = following[np.searchsorted(changes, frames, side="right")]
    result: Array = heights[np.where(way == 0.0, frames, ends)]
    return result
