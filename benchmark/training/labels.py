"""Training labels of a lift: the mode of motion in each frame, and the end of its stroke."""

from typing import Final

import numpy as np
from colift.agents.agent import FRAME
from numpy.typing import NDArray

Array = NDArray[np.float64]

STILL: Final = 0.02
"""Speed below which a person is still [m/s]: a tenth of a lift's peak, four times a tremor's."""

AHEAD: Final = 0.3
"""Time between the two velocities that define a mode [s]: the time until an action taken now has
its effect, including the latency of its observation."""

HALF: Final = 3
"""Half of the frames over which a velocity is taken, to smooth out a tremor."""


def velocities(heights: Array) -> Array:
    """Return the velocity [m/s] in each frame, over :data:`HALF` frames before and after.

    The height is constant before the first frame and after the last.

    Parameters
    ----------
    heights
        (n,) height in each frame [m].
    """
    padded = np.pad(heights, HALF, mode="edge")
    velocity: Array = (padded[2 * HALF :] - padded[: -2 * HALF]) / (2 * HALF * FRAME)
    return velocity


def modes(heights: Array) -> Array:
    """Return the mode (:data:`.MODES`) of each frame of a lift as an (n, 5) array of 0 and 1.

    Parameters
    ----------
    heights
        (n,) height of the person's end in each frame [m]; the last stays.
    """
    now = velocities(heights)
    ahead = round(AHEAD / FRAME)
    later = np.concatenate((now[ahead:], np.zeros(min(ahead, len(now)))))
    moves, continues = np.abs(now) >= STILL, np.abs(later) >= STILL
    same = np.sign(now) == np.sign(later)
    columns = (
        ~moves & ~continues,
        ~moves & continues,
        moves & continues & same,
        moves & ~continues,
        moves & continues & ~same,
    )
    return np.stack(columns, axis=1).astype(np.float64)


def stroke_ends(heights: Array) -> Array:
    """Return the height at which the stroke in progress ends [m], for each frame of a lift.

    A stroke ends in the first frame that is still or moves the other way. A still frame is its own
    end.

    Parameters
    ----------
    heights
        (n,) height of the person's end in each frame [m]; the last stays.
    """
    velocity = velocities(heights)
    direction = np.where(np.abs(velocity) >= STILL, np.sign(velocity), 0.0)
    changes = np.flatnonzero(np.diff(direction)) + 1
    frames = np.arange(len(heights))
    following = np.append(changes, len(heights) - 1)
    ends = following[np.searchsorted(changes, frames, side="right")]
    result: Array = heights[np.where(direction == 0.0, frames, ends)]
    return result
