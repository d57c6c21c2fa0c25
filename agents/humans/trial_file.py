"""A CSV file of recorded lifts."""

from collections.abc import Mapping, Sequence
from pathlib import Path

import numpy as np
from colift.agents.humans.artefacts import Series, fault
from colift.agents.humans.beside import beside_fault
from colift.agents.humans.copies import first_copy
from colift.agents.humans.recording_file import Row, read_rows
from colift.agents.humans.recordings import BESIDE, COLUMNS, FAR, FORCE, TILT, Recording
from colift.agents.humans.trial import Trial
from colift.base.errors import InputError


def load_recordings(path: str | Path) -> tuple[Recording, ...]:
    """Return the recordings of a CSV file with the columns ``trial,t_s,z_m``, in order.

    A column ``person`` names the person of each trial: lifts of one person are one unit in
    intervals and tests. Heights [m] may have any origin within 10 m, times [s] any rate from 10 Hz.

    Raises
    ------
    InputError
        As :func:`load_trials`.
    """
    return tuple(trial.recording for trial in load_trials(path))


def load_trials(path: str | Path) -> tuple[Trial, ...]:
    """Return the recordings of a CSV file with what was measured beside them, in order.

    The columns ``phase``, ``z_far_m``, ``tilt_deg`` and ``force_n`` are optional, and may be empty
    in whole trials. Other columns are ignored.

    Raises
    ------
    InputError
        If the file cannot be read or has another format, a column is missing or there twice, a
        value is not a number, a trial has an artefact of :mod:`.artefacts` or :mod:`.beside` or two
        persons, two names are the same number, or two trials are the same lift. The message names
        the line and the cure.
    """
    path = Path(path)
    rows: dict[str, list[Row]] = {}
    for row in read_rows(path):
        found = rows.setdefault(row.trial, [])
        if found and found[0].person != row.person:
            raise InputError(
                f"{path}, line {row.line}: trial {row.trial!r:.80} is of person "
                f"{row.person!r:.80}, and of {found[0].person!r:.80} before: a trial is one lift "
                "of one person"
            )
        found.append(row)
    if not rows:
        raise InputError(f"{path}: no samples, needs rows of {','.join(COLUMNS)}")
    _check_names(path, rows)
    trials = tuple(_trial(path, each) for each in rows.values())
    copy = first_copy([trial.recording for trial in trials])
    if copy is not None:
        one, other = (trials[i].recording.name for i in copy)
        raise InputError(
            f"{path}, line {rows[other][0].line}: trial {other!r:.80} is the same lift as "
            f"{one!r:.80}: keep one of them, since a copy would count as a further lift in "
            "intervals and tests"
        )
    return trials


def _trial(path: Path, rows: Sequence[Row]) -> Trial:
    times, heights = np.array([row.time for row in rows]), np.array([row.height for row in rows])
    columns = dict(zip(BESIDE, np.array([row.beside for row in rows]).T, strict=True))
    beside = {name: values for name, values in columns.items() if not np.isnan(values).all()}
    found = fault(times, heights) or beside_fault(times, heights, beside)
    if found is not None:
        line = rows[found.sample].line
        raise InputError(f"{path}, line {line}: trial {rows[0].trial!r:.80} {found.text}")
    phases = tuple(row.phase for row in rows)
    return Trial(
        recording=Recording(
            name=rows[0].trial,
            times=tuple(times.tolist()),
            heights=tuple(heights.tolist()),
            person=rows[0].person,
        ),
        far=_values(beside, FAR),
        tilts=_values(beside, TILT),
        forces=_values(beside, FORCE),
        phases=phases if any(phases) else (),
    )


def _values(beside: Mapping[str, Series], column: str) -> tuple[float, ...]:
    return tuple(beside[column].tolist()) if column in beside else ()


def _check_names(path: Path, rows: Mapping[str, Sequence[Row]]) -> None:
    """Refuse names that are the same number, such as ``1`` and ``1.0``."""
    numbers: dict[float, str] = {}
    for trial, samples in rows.items():
        try:
            number = float(trial)
        except ValueError:
            continue
        other = numbers.setdefault(number, trial)
        if other != trial:
            raise InputError(
                f"{path}, line {samples[0].line}: the trials {other!r:.80} and {trial!r:.80} are "
                "the same number: write one lift's name in one form, or give two lifts different "
                "names"
            )
