"""Humans: subjects, their plans, and the movements that carry the plans out.

A subject and a behaviour make a plan from a seed; ``ScriptedHuman`` carries a plan out.
"""

from .changing_goal import ChangingGoal
from .cued import LIVE_SUBJECT, Cue, Cued
from .goals import GoalError, goal_error_mm, goal_errors, missed_words
from .hand_log import Hand, HandLog, LoggedHand, Resampler
from .jerky import Jerky
from .partner import PARTNER_SUBJECT, Partner
from .pause import Pause
from .person_as_robot import PersonAsRobot
from .plan import Behaviour, Embodied, Plan
from .played import Played, PlayedHand
from .recorded import Recorded
from .recording_file import load_recordings
from .recordings import Recording
from .scripted import ScriptedHuman
from .smooth import Smooth
from .subject import BOUNDS, GOAL_RANGE, SUBJECTS, Subject

__all__ = [
    "BOUNDS",
    "GOAL_RANGE",
    "LIVE_SUBJECT",
    "PARTNER_SUBJECT",
    "SUBJECTS",
    "Behaviour",
    "ChangingGoal",
    "Cue",
    "Cued",
    "Embodied",
    "GoalError",
    "Hand",
    "HandLog",
    "Jerky",
    "LoggedHand",
    "Partner",
    "Pause",
    "PersonAsRobot",
    "Plan",
    "Played",
    "PlayedHand",
    "Recorded",
    "Recording",
    "Resampler",
    "ScriptedHuman",
    "Smooth",
    "Subject",
    "goal_error_mm",
    "goal_errors",
    "load_recordings",
    "missed_words",
]
