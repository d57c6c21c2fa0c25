"""The score of a lift while it is played, so that its changes can be rewards: engine and twin."""

from collections.abc import Sequence
from typing import Any, Final

from colift.agents.rules import ArrayFunctions, N
from colift.benchmark.episode.metrics import FAILED_FRAME_MM

WORST: Final = (FAILED_FRAME_MM / 1000) ** 2
"""Square of the error that counts for a frame after a failure [m2]."""


def known_squares(f: ArrayFunctions[N], gathered: Sequence[N], stays: Sequence[int]) -> list[N]:
    """Return the squares that are known before the end [m2]; see :attr:`.Touch.stays`.

    A place that has to be held does not count before the lift comes near; then it counts in full,
    and less and less as the lift comes nearer.
    """
    return [
        f.where(each < WORST, each, 0.0) if stay else each
        for stay, each in zip(stays, gathered, strict=True)
    ]


def square_at_end(error: Any, played: Any, missing: Any) -> Any:
    """Return the square of a score [m2].

    Parameters
    ----------
    error
        Square of the error in the frames that were played [m2].
    played, missing
        Numbers of frames.
    """
    return (played * error + missing * WORST) / (played + missing)
