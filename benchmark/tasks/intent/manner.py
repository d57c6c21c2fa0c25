"""The manner in which a person leads another to a pose of the table."""

from collections.abc import Mapping
from typing import Final, Generic, NamedTuple

from colift.agents.humans import SUBJECTS, Subject
from colift.agents.humans.person import Trait, drawn_traits
from colift.agents.rules import N


class LeadingManner(NamedTuple, Generic[N]):
    """The share of an intention that a person's wrists show, its lead, and the patience.

    The numbers are those of one person, or arrays of many.
    """

    wrist: N
    """Share of the intended pitch that the wrists turn to. A person with little of it leads by
    waiting rather than by torque. It is negative if the wrists turn along with the forearms: a
    person who raises a hand from the elbow tilts it up, whatever the table should do."""
    lead: N
    """Lead of the wrists over the hands [s]; negative if they follow."""
    patience: N
    """Distance of the far end from its intended height [m] beyond which the person slows down; at
    twice this distance the person waits."""


TRAITS: Final[Mapping[str, Trait]] = {
    "wrist": Trait(-0.4, 1.2),
    "lead": Trait(-0.1, 0.2),
    "patience": Trait(0.02, 0.08),
}
"""Ranges of the population, uniform and independent: chosen, wide enough that people differ in how
their intention shows."""

MANNERS: Final[Mapping[str, LeadingManner[float]]] = {
    "S1": LeadingManner(wrist=1.2, lead=0.1, patience=0.06),
    "S2": LeadingManner(wrist=0.6, lead=0.0, patience=0.03),
    "S3": LeadingManner(wrist=-0.4, lead=0.1, patience=0.05),
    "S4": LeadingManner(wrist=0.1, lead=0.0, patience=0.03),
    "S5": LeadingManner(wrist=-0.2, lead=0.2, patience=0.08),
}
"""The manners of the stress people, placed at the ends of the ranges."""


def leading_manner(subject: Subject) -> LeadingManner[float]:
    """Return a person's manner: for stress people as stated, for others drawn by name."""
    if subject.name in SUBJECTS:
        return MANNERS[subject.name]
    return LeadingManner(**drawn_traits(TRAITS, subject, 0x1EAD))
