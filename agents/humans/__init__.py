"""Humans: subjects, their plans, and the movements that carry the plans out.

A subject and a behaviour make a plan from a seed; ``ScriptedHuman`` carries a plan out.
"""

from colift.agents.humans.as_recorded import AsRecorded
from colift.agents.humans.changing_goal import ChangingGoal
from colift.agents.humans.cued import LIVE_SUBJECT, Cue, Cued
from colift.agents.humans.goals import GoalError, goal_error_mm, goal_errors, missed_words
from colift.agents.humans.hand_log import Hand, HandLog, LoggedHand, Resampler
from colift.agents.humans.jerky import Jerky
from colift.agents.humans.pause import Pause
from colift.agents.humans.person_as_robot import PersonAsRobot
from colift.agents.humans.plan import Behaviour, Embodied, Plan
from colift.agents.humans.played import Played, PlayedHand
from colift.agents.humans.recorded import Recorded
from colift.agents.humans.recordings import Recording
from colift.agents.humans.scripted import ScriptedHuman
from colift.agents.humans.second_person import SECOND_PERSON, SecondPerson
from colift.agents.humans.smooth import Smooth
from colift.agents.humans.subject import BOUNDS, GOAL_RANGE, SUBJECTS, Subject
from colift.agents.humans.trial import Trial
from colift.agents.humans.trial_file import load_recordings, load_trials

__all__ = [
    "BOUNDS",
    "GOAL_RANGE",
    "LIVE_SUBJECT",
    "SECOND_PERSON",
    "SUBJECTS",
    "AsRecorded",
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
    "Pause",
    "PersonAsRobot",
    "Plan",
    "Played",
    "PlayedHand",
    "Recorded",
    "Recording",
    "Resampler",
    "ScriptedHuman",
    "SecondPerson",
    "Smooth",
    "Subject",
    "Trial",
    "goal_error_mm",
    "goal_errors",
    "load_recordings",
    "load_trials",
    "missed_words",
]
