"""The scenarios of live lifts: cues in their order, and replays of people."""

from pathlib import Path
from typing import Final

from ...agents.errors import InputError
from ...agents.humans import LIVE_SUBJECT, SUBJECTS, Cued, HandLog, Played
from ...agents.humans.cued import KINDS
from ..bundle import Bundle, read_bundle
from ..episode.scenario import LATENCY, Scenario
from ..episode.seeding import derive_seed
from ..suites.catalogue import PLAYED
from ..suites.suite import Suite, plain_name, recorded_suite
from .session import lift_folders

SEED: Final = 0
"""The episode's seed: lifts, with their plans and their noise, differ by their trial."""

MIXTURES: Final[tuple[str, ...]] = (*KINDS, "mixed")

GHOST_SUBJECT: Final = "S2"
"""The simulated person whose arm real people use, and who lifts by the same cues for comparison."""


def cue_of(seed: int, place: int, mixture: str) -> Cued:
    """Return the cue of a session's lift with a partner; all partners have the same ones.

    Parameters
    ----------
    seed
        The session's seed.
    place
        Number of earlier lifts with this partner.
    mixture
        One kind for every lift, or ``mixed``: each group of three lifts has all kinds, in an order
        that follows from the seed.
    """
    if mixture == "mixed":
        block, place_in_block = divmod(place, len(KINDS))
        order = sorted(KINDS, key=lambda kind: derive_seed(seed, f"order/{block}/{kind}"))
        kind = order[place_in_block]
    else:
        kind = next(each for each in KINDS if each == mixture)
    return Cued(kind=kind, seed=derive_seed(seed, f"cue/{place}/{kind}"))


def live_scenario(cue: Cued, number: int, seat: str, latency: float = LATENCY) -> Scenario:
    """Return the scenario of a live lift, before it has been made."""
    return Scenario(
        behaviour=PLAYED,
        human=cue,
        trial=f"{number:03d}-{cue.kind}",
        subject=LIVE_SUBJECT,
        partner=seat,
        latency=latency,
    )


def ghost_scenario(cue: Cued, number: int) -> Scenario:
    """Return the scenario of two simulated people with the same cue."""
    return Scenario(
        behaviour="cued",
        human=cue,
        trial=f"{number:03d}-{cue.kind}",
        subject=SUBJECTS[GHOST_SUBJECT],
        partner="human",
    )


def played_suite(session: Path) -> Suite:
    """Return a suite of a session's lifts: each person moves as in the lift, frame for frame.

    A lift keeps the movement and not the pointer's samples, which are personal data. Lifts that
    ended early are left out: their movements are incomplete.

    Raises
    ------
    InputError
        If it is not a session, has no complete lift, or a bundle cannot be read.
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
    """Return trial, person and references [m] of a bundle's lift, if it did not end early."""
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
        If the file or the session cannot be used; the message states the reason.
    """
    return played_suite(path) if path.is_dir() else recorded_suite(path)
