"""Suites of real lifts: the people of a session or of recordings, for any policy."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Final

from colift.agents.humans import LIVE_SUBJECT, HandLog, Played, missed_words
from colift.base.errors import InputError
from colift.benchmark.bundle import one_line, read_bundle
from colift.benchmark.episode.scenario import Scenario
from colift.benchmark.real_lifts.session_folder import lift_folders
from colift.benchmark.results.goals import lift_goal_errors
from colift.benchmark.suites.catalogue import PLAYED
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
    """The reason why each other lift of a session does not count, by the name of its folder."""


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


def real_lifts(path: Path) -> RealLifts:
    """Return the real lifts in a file of recordings or in a session's folder.

    Raises
    ------
    InputError
        If the file or the session cannot be used; the message states the reason.
    """
    return played_lifts(path) if path.is_dir() else RealLifts(suite=recorded_suite(path))
