"""Tables of any other program: CSV and other text with columns, in any dialect.

Columns are known by their names: times or frames, the axes of points, and the trial, the marker and
the person where rows of several follow each other.
"""

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Final

import numpy as np
from colift.agents.humans.recordings import COLUMNS
from colift.base.errors import InputError
from colift.benchmark.recordings.clocks import clock_of
from colift.benchmark.recordings.columns import PEOPLE, POINTS, TRIALS, places_of, plain_name
from colift.benchmark.recordings.headers import Table, check_single, table_of
from colift.benchmark.recordings.motion import AXES, Motion, Series
from colift.benchmark.recordings.points import common_unit, scattered
from colift.benchmark.recordings.texts import is_number, text_in
from numpy.typing import NDArray

TRIAL, POINT, PERSON = "trial", "point", "person"
ROLES: Final = {TRIAL: TRIALS, POINT: POINTS, PERSON: PEOPLE}
"""Names of the columns that tell whose rows they are."""


def read(path: Path) -> tuple[Motion, ...]:
    """Return the points of each trial.

    Raises
    ------
    InputError
        If the table has no columns of positions, a field is no number, or a row has more fields
        than there are columns.
    """
    where = str(path)
    table = table_of(text_in(path), where)
    roles = _roles(table, where)
    titles = ["" if i in roles.values() else title for i, title in enumerate(table.titles)]
    places = places_of(titles, table.units, where)
    if not places:
        shown = ", ".join(repr(title)[:40] for title in table.titles[:8])
        raise InputError(
            f"{where}: no column is a position, such as 'RHand Z' or 'z_m'; found {shown}: name "
            "the columns by point and axis, or export positions"
        )
    unit, metre = common_unit(places, where) or ("", 1.0)
    names, positions = scattered(table.lines, places, table.titles, table.decimal, where)
    clock = clock_of(table, where)
    axes = {column.axis for column in places.values()}
    several = len(axes) > 1
    made = []
    for (person, take), rows in _groups(table, roles).items():
        points, times, there, first = _separate(table, roles, rows, names, positions, clock.values)
        made.append(
            Motion(
                kind="a table of text",
                names=points,
                times=times,
                positions=metre * there,
                places=np.array([table.lines[i].number for i in first]),
                unit=unit,
                metre=metre,
                up="Z" if several else AXES[min(axes)],
                up_source="" if several else "file",
                take=take,
                person=person,
                clocked=clock.seconds,
                second=clock.unit,
                hand=COLUMNS[2] if COLUMNS[2] in points else "",
            )
        )
    return tuple(made)


def _roles(table: Table, where: str) -> dict[str, int]:
    """Return the columns of trial, point and person, of those that there are, each there once."""
    found: dict[str, int] = {}
    for i, title in enumerate(table.titles):
        name = plain_name(title)
        role = next((role for role, names in ROLES.items() if name in names), None)
        if role == POINT and is_number(table.lines[0].at(i)):
            continue  # Such as a force at the hand.
        if role is not None:
            found.setdefault(role, i)
    for i in found.values():
        check_single(table, i, where)
    return found


def _groups(table: Table, roles: Mapping[str, int]) -> dict[tuple[str, str], list[int]]:
    """Return the rows of each person and trial, in the order of the file."""
    groups: dict[tuple[str, str], list[int]] = {}
    for i, line in enumerate(table.lines):
        person, take = (line.at(roles[role]) if role in roles else "" for role in (PERSON, TRIAL))
        groups.setdefault((person, take), []).append(i)
    return groups


def _separate(
    table: Table,
    roles: Mapping[str, int],
    rows: Sequence[int],
    names: Sequence[str],
    positions: NDArray[np.float64],
    times: Series,
) -> tuple[tuple[str, ...], Series, NDArray[np.float64], list[int]]:
    """Return points, times, positions and rows of a trial.

    Of points in rows of their own, the times are all that occur.
    """
    titled = tuple(name or _title(table, names) for name in names)
    if POINT not in roles:
        return titled, times[rows], positions[rows], [*rows]
    labels = [table.lines[i].at(roles[POINT]) for i in rows]
    found = tuple(dict.fromkeys(labels))
    points = tuple(f"{label} {name}".strip() for label in found for name in names)
    by_time: dict[float, int] = {}
    seen: set[tuple[str, float]] = set()
    for i, label in zip(rows, labels, strict=True):
        if (label, times[i]) in seen or np.isnan(times[i]):  # No clock, which is refused later.
            return titled, times[rows], positions[rows], [*rows]
        seen.add((label, times[i]))
        by_time.setdefault(float(times[i]), i)
    moments = sorted(by_time)
    index = {moment: k for k, moment in enumerate(moments)}
    there = np.full((len(moments), len(found), len(names), 3), np.nan)
    for i, label in zip(rows, labels, strict=True):
        there[index[float(times[i])], found.index(label)] = positions[i]
    return (
        points,
        np.array(moments),
        there.reshape(len(moments), len(points), 3),
        [by_time[moment] for moment in moments],
    )


def _title(table: Table, names: Sequence[str]) -> str:
    """Return a name for a point without one: the title of its column, if there is one alone."""
    places = places_of(table.titles, table.units, "")
    titles = [table.titles[i] for i, column in places.items() if not column.point]
    return titles[0] if len(titles) == 1 else "point"
