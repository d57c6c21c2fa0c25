"""The human's strokes in a measured trial, found without a plan."""

from typing import Final

import numpy as np
from colift.agents.agent import FRAME
from colift.benchmark.episode.metrics import Stroke
from numpy.typing import NDArray

SMOOTHING: Final = 0.02
"""Standard deviation [s] of the Gaussian kernel that removes the noise of the motion capture before
differentiation: -3 dB at 6.6 Hz, above the movements of a hand."""

ONSET_SHARE: Final = 0.05
"""Share of a trial's greatest speed above which the hand moves."""

LOWEST_SPEED: Final = 0.015
"""Speed below which the hand is still in any case [m/s]."""

LONGEST_GAP: Final = 0.15
"""Longest stop that does not end a stroke [s]."""

SHORTEST_RISE: Final = 0.03
"""Change of height below which a movement is not a stroke [m]."""


def smoothed(height: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return a height without the noise of single frames, of the same length and not shifted."""
    if not len(height):
        return height
    reach = round(4 * SMOOTHING / FRAME)
    kernel = np.exp(-0.5 * (np.arange(-reach, reach + 1) * FRAME / SMOOTHING) ** 2)
    padded = np.pad(height, reach, mode="edge")
    return np.convolve(padded, kernel / kernel.sum(), mode="valid")


def find_strokes(height: NDArray[np.float64]) -> tuple[Stroke, ...]:
    """Return the movements of a hand: first frame, and the frame after the last, of each.

    Parameters
    ----------
    height
        Smoothed height [m] at 100 Hz, shape (n,).
    """
    if len(height) < 2:
        return ()
    speed = np.abs(np.gradient(height, FRAME))
    moving = speed > max(LOWEST_SPEED, ONSET_SHARE * float(speed.max()))
    edges = np.flatnonzero(np.diff(np.concatenate([[False], moving, [False]]).astype(int)))
    runs = [(int(start), int(stop)) for start, stop in edges.reshape(-1, 2)]
    joined: list[Stroke] = []
    for start, stop in runs:
        if joined and start - joined[-1][1] < LONGEST_GAP / FRAME:
            joined[-1] = (joined[-1][0], stop)
        else:
            joined.append((start, stop))
    return tuple(
        (start, stop) for start, stop in joined if np.ptp(height[start:stop]) >= SHORTEST_RISE
    )
