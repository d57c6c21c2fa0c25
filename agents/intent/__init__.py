"""People who intend a pose of the whole table."""

from .leader import Leader, with_far_target
from .manner import MANNERS, LeadingManner, leading_manner
from .poses import Counter, Pivot, PosePlan, Posing, Switching, Together

__all__ = [
    "MANNERS",
    "Counter",
    "Leader",
    "LeadingManner",
    "Pivot",
    "PosePlan",
    "Posing",
    "Switching",
    "Together",
    "leading_manner",
    "with_far_target",
]
