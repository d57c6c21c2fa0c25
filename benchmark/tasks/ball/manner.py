"""The manner in which a person steers the ball."""

from collections.abc import Mapping
from typing import Final, Generic, NamedTuple

from colift.agents.humans import SUBJECTS, Subject
from colift.agents.humans.person import Trait, drawn_traits
from colift.agents.rules import N


class SteeringManner(NamedTuple, Generic[N]):
    """A person's share of the steering, and the response to the partner.

    The numbers are those of one person, or arrays of many.
    """

    share: N
    """Part of the wanted height difference of the ends that the person's own end makes; 1 is all of
    it."""
    haste: N
    """Natural frequency with which the person means to bring the ball to its target [rad/s]."""
    lead: N
    """Time by which the person extrapolates the seen motion of the ball [s]."""
    trust: N
    """Part of this share that the person leaves to a partner who seems to do everything."""
    wrist: N
    """Part of the wanted inclination that the wrists turn to, however little the person's end
    does."""


TRAITS: Final[Mapping[str, Trait]] = {
    "share": Trait(0.1, 1.3, wider=False),
    "haste": Trait(1.6, 2.2, wider=False),
    "lead": Trait(0.0, 0.2, wider=False),
    "trust": Trait(0.0, 0.5, wider=False),
    "wrist": Trait(0.03, 0.8, wider=False),
}
"""Ranges of the population, uniform and independent: chosen, from people who leave the ball to the
partner to people who do it all. Beyond them, people who steer with an untrained robot fling the
ball about, and gradients through such lifts overflow."""

MANNERS: Final[Mapping[str, SteeringManner[float]]] = {
    "S1": SteeringManner(share=1.3, haste=2.2, lead=0.2, trust=0.0, wrist=0.4),
    "S2": SteeringManner(share=0.9, haste=2.0, lead=0.2, trust=0.5, wrist=0.5),
    "S3": SteeringManner(share=1.2, haste=2.2, lead=0.1, trust=0.0, wrist=0.5),
    "S4": SteeringManner(share=0.1, haste=1.6, lead=0.2, trust=0.3, wrist=0.8),
    "S5": SteeringManner(share=0.1, haste=1.6, lead=0.2, trust=0.4, wrist=0.03),
}
"""The manners of the stress people, placed at the ends of the ranges."""


PARTNER_MANNER: Final = SteeringManner(share=0.6, haste=1.8, lead=0.2, trust=0.3, wrist=0.5)
"""The manner of the second of two people."""


def steering_manner(subject: Subject) -> SteeringManner[float]:
    """Return a person's manner: for stress people as stated, for others drawn by name."""
    if subject.name in SUBJECTS:
        return MANNERS[subject.name]
    return SteeringManner(**drawn_traits(TRAITS, subject, 0xBA11))
