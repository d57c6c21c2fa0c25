"""The scenarios of live lifts: cues in their order."""

from typing import Final

from colift.agents.humans import LIVE_SUBJECT, SUBJECTS, Cued
from colift.agents.humans.cued import KINDS
from colift.benchmark.episode.scenario import LATENCY, Scenario
from colift.benchmark.episode.seeding import derive_seed
from colift.benchmark.suites.catalogue import PLAYED
from colift.benchmark.tasks.level.task import LEVEL

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
        task=LEVEL,
    )


def ghost_scenario(cue: Cued, number: int) -> Scenario:
    """Return the scenario of two simulated people with the same cue."""
    return Scenario(
        behaviour="cued",
        human=cue,
        trial=f"{number:03d}-{cue.kind}",
        subject=SUBJECTS[GHOST_SUBJECT],
        partner="human",
        task=LEVEL,
    )
