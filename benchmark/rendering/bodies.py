"""The body that a picture shows at the robot's end of the table."""

from typing import Final, Literal

from colift.benchmark.episode.seat import SEATS
from colift.benchmark.world import NaoFarEnd

Body = Literal["nao", "person", "unknown"]
"""A NAO, a person, or a robot of which there is no picture."""

NAO: Final[Body] = "nao"
PERSON: Final[Body] = "person"
UNKNOWN: Final[Body] = "unknown"


def shown_body(partner: str) -> Body:
    """Return the body of a holder of the robot's end, by its name in :data:`.SEATS`."""
    seat = SEATS.get(partner)
    if seat is None:
        return UNKNOWN
    if seat.person is not None:
        return PERSON
    return NAO if isinstance(seat.body, NaoFarEnd) else UNKNOWN


def no_picture(partner: str) -> str:
    """Return the words in place of a robot of which there is no picture."""
    return f"no picture of the robot {partner}"
