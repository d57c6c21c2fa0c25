"""The order of the cues in a session, and the scenario of a lift."""

from typing import Final

from ...agents.humans import LIVE_SUBJECT, SUBJECTS, Cued
from ...agents.humans.cued import KINDS
from ..episode.scenario import LATENCY, Scenario
from ..episode.seeding import derive_seed
from ..suites.catalogue import PLAYED

MIXTURES: Final[tuple[str, ...]] = (*KINDS, "mixed")

GHOST_SUBJECT: Final = "S2"
"""The simulated person whose arm real people have, and who plays their cues for comparison."""


def cue_of(seed: int, place: int, mixture: str) -> Cued:
    """Return the cue of a session's lift with a partner; all partners have the same ones.

    Parameters
    ----------
    seed
        The session's.
    place
        How many lifts with this partner came before.
    mixture
        One kind for every lift, or ``mixed``: each run of three lifts has all kinds, in an order
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
