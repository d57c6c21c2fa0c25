"""Arrays of NumPy: heights, positions of one or more points, or poses of a body, by frame."""

from pathlib import Path

import numpy as np
from colift.base.errors import InputError
from colift.benchmark.recordings.motion import Motion
from numpy.typing import NDArray


def read(path: Path) -> tuple[Motion, ...]:
    """Return the points of an array (frames,), (frames, 3), (frames, points, 3) or (frames, 4, 4).

    The last is the pose of a body, as a homogeneous matrix.

    Raises
    ------
    InputError
        If the file cannot be read without running code, or the array has another shape.
    """
    try:
        array = np.load(path, allow_pickle=False)
    except (OSError, ValueError, EOFError) as error:
        raise InputError(
            f"{path}: this array of NumPy cannot be read ({error!s:.100}): save an array of numbers"
        ) from None
    positions = _positions(array)
    if positions is None:
        raise InputError(
            f"{path}: this array has the shape {array.shape} and the type {array.dtype}, must be "
            "numbers of the shape (frames,), (frames, 3), (frames, points, 3) or (frames, 4, 4)"
        )
    count = positions.shape[1]
    return (
        Motion(
            kind="an array of NumPy",
            names=tuple(f"point {i}" for i in range(count)) if count > 1 else ("point",),
            times=np.arange(len(positions), dtype=float),
            positions=positions,
            places=np.arange(len(positions)),
            place="frame",
            unit="",
            metre=1.0,
            up="Z",
            clocked=False,
        ),
    )


def _positions(array: NDArray[np.generic]) -> NDArray[np.float64] | None:
    if array.dtype.kind not in "fiu" or not array.size:
        return None
    values = array.astype(np.float64)
    match values.shape:
        case (frames,):
            positions = np.full((frames, 1, 3), np.nan)
            positions[:, 0, 2] = values
            return positions
        case (_, 3):
            return values[:, None]
        case (_, _, 3):
            return values
        case (_, 4, 4):
            return values[:, None, :3, 3]
    return None
