"""People who have a hurdle to pass, and a partner who may have another."""

from .companion import Companion
from .hurdles import Abreast, Ahead, Behind, Hurdle, HurdlePlan, NoHurdle, OtherHurdle, OwnHurdle
from .manner import MANNERS, AgreeingManner, agreeing_manner
from .negotiator import Negotiator, OwnVia, with_via

__all__ = [
    "MANNERS",
    "Abreast",
    "AgreeingManner",
    "Ahead",
    "Behind",
    "Companion",
    "Hurdle",
    "HurdlePlan",
    "Negotiator",
    "NoHurdle",
    "OtherHurdle",
    "OwnHurdle",
    "OwnVia",
    "agreeing_manner",
    "with_via",
]
