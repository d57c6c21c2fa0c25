"""People who have a hurdle to pass, and a partner who may have another."""

from colift.agents.humans.agree.hurdles import (
    Abreast,
    Ahead,
    Behind,
    Hurdle,
    HurdlePlan,
    NoHurdle,
    OtherHurdle,
    OwnHurdle,
)
from colift.agents.humans.agree.manner import MANNERS, AgreeingManner, agreeing_manner
from colift.agents.humans.agree.negotiator import Negotiator, with_secret
from colift.agents.humans.agree.precedence import Secret
from colift.agents.humans.agree.second import SecondNegotiator

__all__ = [
    "MANNERS",
    "Abreast",
    "AgreeingManner",
    "Ahead",
    "Behind",
    "Hurdle",
    "HurdlePlan",
    "Negotiator",
    "NoHurdle",
    "OtherHurdle",
    "OwnHurdle",
    "SecondNegotiator",
    "Secret",
    "agreeing_manner",
    "with_secret",
]
