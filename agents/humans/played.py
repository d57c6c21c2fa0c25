"""A lift as a real person lifted it, reference for reference."""

from dataclasses import dataclass

import numpy as np
from colift.agents.agent import Action, Agent, HumanObservation, Observation
from colift.agents.humans.cued import Cued
from colift.agents.humans.hand_log import HandLog, LoggedHand
from colift.agents.humans.plan import Plan
from colift.agents.humans.subject import Subject


@dataclass(frozen=True, kw_only=True)
class Played:
    """Moves the hand as a person did in a live lift: nothing is scaled, slowed or smoothed."""

    cue: Cued
    """The goals that the person had."""
    log: HandLog
    """The samples of the person's hand."""
    far: HandLog | None = None
    """The samples of a second person's hand at the far end, if there was one."""

    def plan(self, subject: Subject, seed: int) -> Plan:
        """Return the movement that the cues asked for; the hand did not follow it exactly."""
        return self.cue.plan(subject, seed)

    def person(self, subject: Subject) -> Agent:
        """Return the hand, as an agent whose actions are its references."""
        return PlayedHand(self.log)


class PlayedHand:
    """An agent that moves the hand of a log, whatever it observes."""

    def __init__(self, log: HandLog) -> None:
        self._hand = LoggedHand(log)

    def reset(self, seed: int) -> None:
        """Begin a lift; nothing is random."""
        self._hand.begin()

    def act(self, observation: Observation) -> Action:
        """Return the references of the next n frames [m]."""
        frames = len(observation[HumanObservation.TARGET])
        return np.array([self._hand.next() for _ in range(frames)])
