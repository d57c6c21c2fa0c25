"""Suites of real lifts: the people of a session or of recordings, for any policy."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Final

from colift.agents.humans import (
    LIVE_SUBJECT,
    AsRecorded,
    HandLog,
    Played,
    Recording,
    load_recordings,
    missed_words,
)
from colift.agents.humans.as_recorded import heights_of
from colift.agents.humans.recorded_series import names_people, series_of
from colift.base.errors import InputError
from colift.benchmark.bundle import one_line, read_bundle
from colift.benchmark.episode.scenario import Scenario
from colift.benchmark.real_lifts.session_folder import lift_folders
from colift.benchmark.results.goals import lift_goal_errors
from colift.benchmark.robots.robot import DEFAULT_ROBOT, make_robot
from colift.benchmark.suites.catalogue import AS_RECORDED, PLAYED, SERIES, make_subject
from colift.benchmark.suites.ranges import RECORDED_PEOPLE
from colift.benchmark.suites.suite import Suite, plain_name, recorded_suite
from colift.benchmark.tasks.level.task import LEVEL

SEED: Final = 0
"""The episode's seed: lifts, with their plans and their noise, differ by their trial."""

MOST_REASONS: Final = 3
"""Most lifts whose reason for not counting an error names."""


@dataclass(frozen=True, kw_only=True)
class RealLifts:
    """Lifts of real people, for any policy."""

    suite: Suite
    """The lifts that count."""
    left_out: Mapping[str, str] = field(default_factory=dict)
    """The reason why each other lift does not count, by its trial or the name of its folder."""
    assumed: str = ""
    """What the lifts are taken for without being told, in words."""


def played_lifts(session: Path) -> RealLifts:
    """Return a session's lifts: each person moves as in the lift, frame for frame.

    A lift keeps the movement and not the pointer's samples, which are personal data. Two kinds are
    left out: those that ended early, whose movements are incomplete, and those in which a goal was
    missed, which sessions of earlier versions contain.

    Raises
    ------
    InputError
        If it is not a session, no lift of it counts, or a bundle cannot be read.
    """
    scenarios, left_out = [], {}
    for folder in lift_folders(session):
        bundle = read_bundle(folder)
        scenario, episode = bundle.recipe.suite().scenarios[0], bundle.episodes[0]
        human = scenario.human
        if not isinstance(human, Played):
            left_out[folder.name] = "not a live lift"
        elif episode.failure is not None:
            left_out[folder.name] = f"it failed: {one_line(episode.failure)}"
        elif (missed := missed_words(lift_goal_errors(human))) is not None:
            left_out[folder.name] = missed
        else:
            references = episode.trace.human_action.ravel().tolist()
            moved = Played(cue=human.cue, log=HandLog.of_references(references))
            played = Scenario(
                behaviour=PLAYED,
                human=moved,
                trial=scenario.trial,
                subject=LIVE_SUBJECT,
                task=LEVEL,
            )
            scenarios.append(played)
    if not scenarios:
        raise InputError(f"{session}: this session has no lift that counts{_reasons(left_out)}")
    name = plain_name(f"live {session.name}")
    suite = Suite(name=name, scenarios=tuple(scenarios), seeds=(SEED,))
    return RealLifts(suite=suite, left_out=left_out)


def _reasons(left_out: Mapping[str, str]) -> str:
    """Return why lifts do not count, as the end of a sentence."""
    shown = [f"; {name}: {reason}" for name, reason in left_out.items()][:MOST_REASONS]
    return "".join(shown) + f"; and {len(left_out) - MOST_REASONS} more" * (
        len(left_out) > MOST_REASONS
    )


def beyond(recordings: Sequence[Recording], room: tuple[float, float]) -> dict[str, str]:
    """Return in words, by trial, which recordings leave a range of heights above the start [m]."""
    ranges = {recording.name: heights_of(recording) for recording in recordings}
    return {
        name: f"as recorded it goes from {low:.2f} to {high:.2f} m about its start, must be within "
        f"{room[0]:g} to {room[1]:g} m"
        for name, (low, high) in ranges.items()
        if low < room[0] or high > room[1]
    }


def lifts_as_recorded(
    recordings: Sequence[Recording], source: str, room: tuple[float, float]
) -> RealLifts:
    """Return recorded lifts at their own height and pace, each with the same arm.

    Parameters
    ----------
    recordings
        The lifts.
    source
        Their origin, for the suite's name.
    room
        Lowest and highest height above the start [m] at which both ends can be held; lifts that go
        beyond are left out.

    Raises
    ------
    InputError
        If all are left out.
    """
    left_out = beyond(recordings, room)
    kept = [recording for recording in recordings if recording.name not in left_out]
    if not kept:
        raise InputError(
            f"{source}: no lift can be played as recorded, only scaled{_reasons(left_out)}"
        )
    scenarios = tuple(
        Scenario(
            behaviour=AS_RECORDED,
            human=AsRecorded(recording=recording),
            trial=recording.name,
            subject=LIVE_SUBJECT,
            task=LEVEL,
        )
        for recording in kept
    )
    name = plain_name(f"recordings {source} as recorded")
    suite = Suite(name=name, scenarios=scenarios, seeds=(SEED,))
    return RealLifts(suite=suite, left_out=left_out)


def recorded_sessions(recordings: Sequence[Recording], source: str) -> RealLifts:
    """Return recorded lifts as sessions, one of each person, scaled like :func:`.recorded_suite`.

    Lifts beyond those of the person with the fewest, and people with one lift, are left out; so are
    lifts without a name beside people who have one.

    Raises
    ------
    InputError
        If nobody has several lifts.
    """
    found = series_of(recordings)
    if not found:
        raise InputError(f"{source}: no person has several lifts: there is no session")
    kept = {recording.name for series in found.values() for recording in series.lifts}
    length = len(next(iter(found.values())).lifts)
    scenarios = tuple(
        Scenario(
            behaviour=SERIES,
            human=series,
            trial=person,
            subject=make_subject(f"draw-{RECORDED_PEOPLE[i % len(RECORDED_PEOPLE)]}"),
            task=LEVEL,
        )
        for i, (person, series) in enumerate(found.items())
    )
    name = plain_name(f"recordings {source} in sessions")
    suite = Suite(name=name, scenarios=scenarios, seeds=tuple(range(length)))
    named = names_people(recordings)
    return RealLifts(
        suite=suite,
        left_out={
            recording.name: f"a session has {length} lifts of each person"
            if recording.person or not named
            else "its person is not named, as others are"
            for recording in recordings
            if recording.name not in kept
        },
        assumed="" if named else "no person is named, so all lifts are taken as one person's",
    )


def real_lifts(
    path: Path, *, as_recorded: bool = False, session: bool = False, robot: str | None = None
) -> RealLifts:
    """Return the real lifts in a file of recordings or in a session's folder.

    Parameters
    ----------
    path
        The file or folder.
    as_recorded
        Whether recordings are played at their own height and pace, as live lifts always are; else
        they are scaled and slowed down.
    session
        Whether the recordings of each person are one session, in their order.
    robot
        The robot at the far end, within whose stroke they must then be; None is the default.

    Raises
    ------
    InputError
        If the file or the session cannot be used; the message states the reason.
    """
    if path.is_dir():
        if session:
            raise InputError(f"{path}: --session is for a file of recordings, not for live lifts")
        return played_lifts(path)
    if session:
        if as_recorded:
            raise InputError("--session and --as-recorded exclude each other")
        return recorded_sessions(load_recordings(path), path.name)
    if not as_recorded:
        return RealLifts(suite=recorded_suite(path))
    stroke = make_robot(robot or DEFAULT_ROBOT).stroke
    return lifts_as_recorded(load_recordings(path), path.name, stroke)
