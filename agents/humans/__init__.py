"""Humans: who they are, what they mean to do, and how they carry it out.

A subject and a behaviour make a plan from a seed; ``ScriptedHuman`` carries a plan out.
"""

from .changing_goal import ChangingGoal
from .jerky import Jerky
from .partner import PARTNER_SUBJECT, Partner
from .pause import Pause
from .plan import Behaviour, Plan
from .recorded import Recorded
from .recordings import Recording, load_recordings
from .scripted import ScriptedHuman
from .smooth import Smooth
from .subject import BOUNDS, GOAL_RANGE, SUBJECTS, Subject

__all__ = [
    "BOUNDS",
    "GOAL_RANGE",
    "PARTNER_SUBJECT",
    "SUBJECTS",
    "Behaviour",
    "ChangingGoal",
    "Jerky",
    "Partner",
    "Pause",
    "Plan",
    "Recorded",
    "Recording",
    "ScriptedHuman",
    "Smooth",
    "Subject",
    "load_recordings",
]
