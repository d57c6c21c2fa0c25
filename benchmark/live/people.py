"""The people of a session, to be lifted with again by any policy."""

from pathlib import Path

from ...agents.errors import InputError
from ...agents.humans import LIVE_SUBJECT, HandLog, Played
from ..bundle import Bundle, read_bundle
from ..episode.scenario import Scenario
from ..suites.catalogue import PLAYED
from ..suites.suite import Suite, plain_name, recorded_suite
from .lifting import SEED
from .session import lift_folders


def played_suite(session: Path) -> Suite:
    """Return a suite of a session's lifts: each person moves as in the lift, frame for frame.

    A lift keeps the movement and not the pointer's samples, which are personal data. Lifts that
    ended early are left out: their movements have no end.

    Raises
    ------
    InputError
        If it is no session, has no complete lift, or a bundle cannot be read.
    """
    scenarios = tuple(
        Scenario(
            behaviour=PLAYED,
            human=Played(cue=human.cue, log=HandLog.of_references(references)),
            trial=trial,
            subject=LIVE_SUBJECT,
        )
        for bundle in map(read_bundle, lift_folders(session))
        for trial, human, references in _complete(bundle)
    )
    if not scenarios:
        raise InputError(f"{session}: this session has no complete lift yet")
    return Suite(name=plain_name(f"live {session.name}"), scenarios=scenarios, seeds=(SEED,))


def _complete(bundle: Bundle) -> list[tuple[str, Played, list[float]]]:
    """Return trial, person and references [m] of a bundle's lift, if it was not ended early."""
    scenario, episode = bundle.recipe.suite().scenarios[0], bundle.episodes[0]
    human = scenario.human
    if episode.failure is not None or not isinstance(human, Played):
        return []
    return [(scenario.trial, human, episode.trace.human_action.ravel().tolist())]


def real_lifts(path: Path) -> Suite:
    """Return the suite of real lifts in a file of recordings or in a session's folder.

    Raises
    ------
    InputError
        If the file or the session cannot be used; the message says why.
    """
    return played_suite(path) if path.is_dir() else recorded_suite(path)
