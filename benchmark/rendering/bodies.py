"""The body that a picture shows at the robot's end of the table."""

from typing import Final, Literal

from colift.base.errors import InputError
from colift.benchmark.episode.seat import HUMANS
from colift.benchmark.robots.robot import Robot, make_robot

PERSON: Final = "person"

Body = Robot | Literal["person"] | None
"""A robot, a person, or None for a robot whose package is not installed."""


def shown_body(partner: str) -> Body:
    """Return the body of a holder of the robot's end, by its name."""
    if partner in HUMANS:
        return PERSON
    try:
        return make_robot(partner)
    except InputError:
        return None


def no_picture(partner: str) -> str:
    """Return the words in place of a robot of which there is no picture."""
    return f"no picture of the robot {partner}"


def label_of(partner: str) -> str:
    """Return the name of a holder of the robot's end in pictures."""
    body = shown_body(partner)
    if body is None:
        return partner
    return HUMANS[partner].label if body == PERSON else body.label
