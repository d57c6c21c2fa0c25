"""Scenarios, subjects and tasks by name."""

from pathlib import Path
from typing import Final

from colift.agents.humans import (
    LIVE_SUBJECT,
    SUBJECTS,
    Behaviour,
    Recording,
    Subject,
    load_recordings,
)
from colift.base.errors import InputError
from colift.base.near_names import did_you_mean
from colift.base.plugins import make_registered
from colift.base.registry import HUMANS, TASKS, called, entries
from colift.benchmark.episode.conformance import behaviour_fault, task_fault
from colift.benchmark.episode.scenario import CONTROL_PERIOD, LATENCY, Scenario
from colift.benchmark.episode.task import Task
from colift.benchmark.robots.robot import DEFAULT_ROBOT

TASK: Final = "level"
"""The default task, that of the paper."""

RECORDED: Final = "recorded"

AS_RECORDED: Final = "as_recorded"

OF_RECORDINGS: Final = (RECORDED, AS_RECORDED)
"""The behaviours of people in files of recordings: scaled, or at their own height and pace."""

SERIES: Final = "recorded_series"
"""The behaviour of a person's recorded lifts in a row; it is not registered: it needs several."""

FROM_FILES: Final = (*OF_RECORDINGS, SERIES)
"""All behaviours of people in files of recordings."""

PLAYED: Final = "played"
"""The behaviour of live lifts; it is not registered, since it needs their recorded hands."""

REAL: Final = (*FROM_FILES, PLAYED)
"""The behaviours of real people."""


def make_subject(name: str) -> Subject:
    """Return a subject by name: one of the five, ``draw-N`` (a new person by seed N), or ``live``.

    Raises
    ------
    InputError
        If the name is unknown; the message lists all names.
    """
    if name in SUBJECTS:
        return SUBJECTS[name]
    if name == LIVE_SUBJECT.name:
        return LIVE_SUBJECT
    kind, _, seed = name.partition("-")
    if kind == "draw" and seed.isdecimal():
        return Subject.draw(int(seed))
    near = did_you_mean(name, SUBJECTS)
    raise InputError(f"unknown subject {name!r}; {near}known: {', '.join(SUBJECTS)}, draw-N")


def make_task(name: str) -> Task:
    """Return the task that is registered under ``name``, with its default parameters.

    Raises
    ------
    InputError
        If the name is unknown, or there is no task of that name in its package.
    """
    task: Task = make_registered(TASKS, name, task_fault)
    if task.name != name:
        fault = f"has the name {task.name!r}; it must have its entry point's name"
        raise InputError(f"{called(TASKS, name)} {fault}")
    return task


def _recording(source: str, kind: str) -> Recording:
    """Return the recording of ``FILE.csv`` (its first trial) or ``FILE.csv#TRIAL``."""
    path, _, trial = source.partition("#")
    if not path:
        raise InputError(f"no recording is named: give {kind}:FILE.csv or {kind}:FILE.csv#TRIAL")
    recordings = {recording.name: recording for recording in load_recordings(Path(path))}
    if trial and trial not in recordings:
        raise InputError(f"{path} has no trial {trial!r}; it has {', '.join(recordings)}")
    return recordings[trial] if trial else next(iter(recordings.values()))


def make_scenario(
    behaviour: str,
    subject: str = "S1",
    partner: str = DEFAULT_ROBOT,
    control_period: float = CONTROL_PERIOD,
    latency: float = LATENCY,
    task: str = TASK,
) -> Scenario:
    """Return a scenario from names.

    Parameters
    ----------
    behaviour
        A registered human behaviour, with its default parameters. ``recorded:FILE.csv`` is the
        first trial of a file of recordings, ``recorded:FILE.csv#TRIAL`` the one of that name;
        ``as_recorded:`` plays them at their own height and pace.
    subject
        One of the five, or ``draw-N``, a new person by seed N.
    partner, control_period, latency
        As in :class:`Scenario`.
    task
        A registered task, with its default parameters.

    Raises
    ------
    InputError
        If a name is unknown or its package has no such object, a time is out of range, or a file
        cannot be used.
    """
    kind, _, source = behaviour.partition(":")
    plain, comma, parameters = kind.partition(",")
    if comma and plain in entries(HUMANS):
        raise InputError(
            f"behaviours take no parameters here: {plain!r} has those of its class, got "
            f"{parameters!r}"
        )
    recording = _recording(source, kind) if kind in OF_RECORDINGS else None
    given = {} if recording is None else {"recording": recording}
    human: Behaviour = make_registered(HUMANS, kind, behaviour_fault, **given)
    return Scenario(
        behaviour=kind,
        human=human,
        trial="" if recording is None else recording.name,
        subject=make_subject(subject),
        partner=partner,
        control_period=control_period,
        latency=latency,
        task=make_task(task),
    )
