"""People who intend a pose of the whole table."""

from colift.agents.humans.intent.companion import Companion
from colift.agents.humans.intent.manner import MANNERS, LeadingManner, leading_manner
from colift.agents.humans.intent.pace import (
    PaceMemory,
    PaceSenses,
    Pose,
    PosePath,
    intended,
    pace,
)
from colift.agents.humans.intent.poses import Counter, Pivot, PosePlan, Posing, Switching, Together

__all__ = [
    "MANNERS",
    "Companion",
    "Counter",
    "LeadingManner",
    "PaceMemory",
    "PaceSenses",
    "Pivot",
    "Pose",
    "PosePath",
    "PosePlan",
    "Posing",
    "Switching",
    "Together",
    "intended",
    "leading_manner",
    "pace",
]
