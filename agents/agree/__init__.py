"""People who have a hurdle to pass, and a partner who may have another."""

from .companion import Companion
from .hurdles import Abreast, Ahead, Behind, Hurdle, HurdlePlan, NoHurdle, OtherHurdle, OwnHurdle
from .manner import MANNERS, AgreeingManner, agreeing_manner
from .negotiator import Negotiator, Secret, with_secret

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
    "Secret",
    "agreeing_manner",
    "with_secret",
]
