"""People who have a hurdle to pass, and a partner who may have another."""

from colift.agents.tasks.agree.hurdles import (
    Abreast,
    Ahead,
    Behind,
    Hurdle,
    HurdlePlan,
    NoHurdle,
    OtherHurdle,
    OwnHurdle,
)
from colift.agents.tasks.agree.manner import MANNERS, AgreeingManner, agreeing_manner
from colift.agents.tasks.agree.person import Negotiates
from colift.agents.tasks.agree.precedence import Obstacle, Secret, secret
from colift.agents.tasks.agree.second import SecondNegotiator, with_secret

__all__ = [
    "MANNERS",
    "Abreast",
    "AgreeingManner",
    "Ahead",
    "Behind",
    "Hurdle",
    "HurdlePlan",
    "Negotiates",
    "NoHurdle",
    "Obstacle",
    "OtherHurdle",
    "OwnHurdle",
    "SecondNegotiator",
    "Secret",
    "agreeing_manner",
    "secret",
    "with_secret",
]
