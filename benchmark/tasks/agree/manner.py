"""The manner in which a person comes to an agreement with a partner."""

from collections.abc import Mapping
from typing import Final, Generic, NamedTuple

from colift.agents.humans import SECOND_PERSON, Subject
from colift.agents.humans.person import Trait, drawn_traits
from colift.agents.rules import N


class AgreeingManner(NamedTuple, Generic[N]):
    """A person's readiness to go first, and to go along with the other.

    The numbers are those of one person, or arrays of many.
    """

    patience: N
    """Time for which the person lets the other go first, relative: at 0 the person sets out as the
    window opens, at 1 at the last moment that leaves enough time, below 0 early, above 1 too
    late."""
    trust: N
    """Share of the way to the partner's inferred goal that the person goes."""
    stiffness: N
    """Weight of the person's own goal against a level table, in [0, 1]; the remainder gives way to
    the far end."""
    insistence: N
    """Time for which the person insists when both go to their own goals, before giving way [s];
    beyond :data:`.STUBBORN`, the person does not let the other go first either."""


TRAITS: Final[Mapping[str, Trait]] = {
    "patience": Trait(-0.5, 1.3, least=-1.0),
    "trust": Trait(0.75, 1.0, least=0.0, most=1.0),
    "stiffness": Trait(0.6, 1.0, least=0.0, most=1.0),
    "insistence": Trait(0.2, 4.0, least=0.0),
}
"""Ranges of the population, uniform and independent: chosen, wide enough that the eager and the
timid need different partners."""

MANNERS: Final[Mapping[str, AgreeingManner[float]]] = {
    "S1": AgreeingManner(patience=0.0, trust=0.75, stiffness=1.0, insistence=2.0),
    "S2": AgreeingManner(patience=1.15, trust=1.0, stiffness=0.6, insistence=0.2),
    "S3": AgreeingManner(patience=0.0, trust=0.9, stiffness=0.9, insistence=1.5),
    "S4": AgreeingManner(patience=1.1, trust=0.8, stiffness=0.8, insistence=1.5),
    "S5": AgreeingManner(patience=0.1, trust=1.0, stiffness=1.0, insistence=1.0),
    SECOND_PERSON.name: AgreeingManner(patience=0.2, trust=1.0, stiffness=0.9, insistence=0.2),
}
"""The manners of the stress people, placed at the ends of the ranges, and of the second human."""


def agreeing_manner(subject: Subject) -> AgreeingManner[float]:
    """Return a person's manner: for stress people as stated, for others drawn by name."""
    if subject.name in MANNERS:
        return MANNERS[subject.name]
    return AgreeingManner(**drawn_traits(TRAITS, subject, 0xA62EE))
