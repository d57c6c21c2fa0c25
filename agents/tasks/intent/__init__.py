"""People who intend a pose of the whole table."""

from colift.agents.tasks.intent.companion import Companion
from colift.agents.tasks.intent.manner import MANNERS, LeadingManner, leading_manner
from colift.agents.tasks.intent.person import Leads
from colift.agents.tasks.intent.poses import Counter, Pivot, PosePlan, Posing, Switching, Together

__all__ = [
    "MANNERS",
    "Companion",
    "Counter",
    "LeadingManner",
    "Leads",
    "Pivot",
    "PosePlan",
    "Posing",
    "Switching",
    "Together",
    "leading_manner",
]
