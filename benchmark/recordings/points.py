"""Positions of points from the columns of a table."""

from collections.abc import Sequence

import numpy as np
from colift.base.errors import InputError
from colift.benchmark.recordings.columns import Column
from colift.benchmark.recordings.motion import AXES, stated_unit
from colift.benchmark.recordings.texts import Line, numbers
from numpy.typing import NDArray


def triples(
    lines: Sequence[Line],
    firsts: Sequence[int],
    names: Sequence[str],
    decimal: str,
    where: str,
) -> NDArray[np.float64]:
    """Return the positions of points with X, Y and Z in columns side by side.

    Parameters
    ----------
    lines
        The data.
    firsts
        Column of the X of each point.
    names
        The points.
    decimal
        The decimal sign.
    where
        The file's name, for messages.

    Returns
    -------
    NDArray[np.float64]
        Shape (lines, points, 3), in the unit of the table.
    """
    columns = [first + axis for first in firsts for axis in range(3)]
    titles = [f"{axis} of {name!r:.40}" for name in names for axis in AXES]
    return numbers(lines, columns, titles, decimal, where).reshape(len(lines), len(names), 3)


def scattered(
    lines: Sequence[Line],
    places: dict[int, Column],
    titles: Sequence[str],
    decimal: str,
    where: str,
) -> tuple[tuple[str, ...], NDArray[np.float64]]:
    """Return names and positions of points whose axes are in any columns; NaN for other axes.

    Parameters
    ----------
    lines
        The data.
    places
        The columns of positions.
    titles
        The names of all columns, for messages.
    decimal
        The decimal sign.
    where
        The file's name, for messages.

    Returns
    -------
    tuple[tuple[str, ...], NDArray[np.float64]]
        The points, and their positions, shape (lines, points, 3), in the unit of the table.
    """
    names = tuple(dict.fromkeys(column.point for column in places.values()))
    values = numbers(lines, [*places], [f"{titles[i]!r:.40}" for i in places], decimal, where)
    positions = np.full((len(lines), len(names), 3), np.nan)
    for k, column in enumerate(places.values()):
        positions[:, names.index(column.point), column.axis] = values[:, k]
    return names, positions


def common_unit(places: dict[int, Column], where: str) -> tuple[str, float] | None:
    """Return the unit of columns of positions; None if they state none.

    Raises
    ------
    InputError
        If they state several.
    """
    units = {column.unit for column in places.values() if column.unit}
    if len(units) > 1:
        raise InputError(
            f"{where}: the columns of positions are in {', '.join(sorted(units))}: write them in "
            "one unit"
        )
    return stated_unit(units.pop()) if units else None
