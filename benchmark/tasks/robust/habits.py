"""The habits of a person, in which people differ and a robot can find out whom it has."""

from collections.abc import Mapping
from typing import Final, NamedTuple

from colift.agents.humans import Subject
from colift.agents.humans.person import Trait, drawn_traits


class Habits(NamedTuple):
    """The habits of one person."""

    wait: float
    """Mean wait before a lift [s]."""
    dip: float
    """Mean depth of a counter-movement [m]."""
    stop: float
    """Height of a stop, relative to the lift's."""
    turn: float
    """Time at which the person turns back, relative to the duration of the upward stroke."""
    back: float
    """Way back after turning, relative to the lift's height."""
    patience: float
    """Height difference of the ends [m] beyond which the person slows down for the robot."""


HABITS: Final[Mapping[str, Trait]] = {
    "wait": Trait(0.6, 5.0),
    "dip": Trait(0.006, 0.022),
    "stop": Trait(0.3, 0.75),
    "turn": Trait(0.35, 0.65),
    "back": Trait(0.2, 0.6),
    "patience": Trait(0.01, 0.04),
}
"""Ranges of the population, uniform and independent: chosen, not measured. A dip stays within the
stroke of the NAO, 30 mm below rest."""

_SALT: Final = 0x4AB17


def habits_of(subject: Subject) -> Habits:
    """Return a person's habits, drawn by name."""
    return Habits(**drawn_traits(HABITS, subject, _SALT))
