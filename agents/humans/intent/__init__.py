"""People who intend a pose of the whole table."""

from .companion import Companion
from .manner import MANNERS, LeadingManner, leading_manner
from .pace import Pace, planned_at
from .poses import Counter, Pivot, PosePlan, Posing, Switching, Together

__all__ = [
    "MANNERS",
    "Companion",
    "Counter",
    "LeadingManner",
    "Pace",
    "Pivot",
    "PosePlan",
    "Posing",
    "Switching",
    "Together",
    "leading_manner",
    "planned_at",
]
