"""Silly policies: each games a number instead of lifting well."""

import math

import numpy as np
from colift.agents.agent import RobotObservation as Seen
from colift.agents.policies.extrapolate import Extrapolate, ExtrapolateParameters

LIFTED = 0.1
"""Height above which a rest is at the top [m]."""

STEADY = 0.004
"""Change of the seen height in a step [m] below which the human rests."""

TWO_PEOPLE = "two people"

SWEPT = 28
"""Steps of a sweep: longer than any window of a hurdle."""


class Level:
    """Goes to the extrapolated height of the human; the others depart from it.

    ``task`` is what it plays. ``behind`` are policies whose mean error must be smaller; ``marked``
    is whether it must carry the mark of those rougher than two people.
    """

    task = "level"
    behind = (TWO_PEOPLE,)
    marked = False
    ahead = 2.0

    def reset(self, seed):
        self.level = Extrapolate(parameters=ExtrapolateParameters(steps=self.ahead))
        self.level.reset(seed)
        self.step, self.last, self.rests = 0, 0.0, 0

    def act(self, observation):
        seen, command = observation[Seen.HUMAN_END], observation[Seen.HAND_COMMAND]
        kept = command + self.level.act(observation)[0]
        self.moved, self.last = seen - self.last, seen
        rests = abs(self.moved) < STEADY and seen > LIFTED
        self.rests = self.rests + 1 if rests else 0
        goal = self.goal(observation, kept)
        self.step += 1
        return np.array([goal - command])

    def goal(self, observation, kept):
        """Return the next command, for one that keeps level."""
        return kept


class Tremble(Level):
    """4 mm up and down in turn: about as level as two people."""

    behind = ("extrapolate",)
    marked = True

    def goal(self, observation, kept):
        return kept + 0.004 * (-1) ** self.step


class DeadZone(Level):
    """Jumps as soon as it is 1 cm off, and does not move before.

    It is about as level as two people, and by no measure rougher: people tremble more.
    """

    behind = ("extrapolate",)

    def goal(self, observation, kept):
        command = observation[Seen.HAND_COMMAND]
        return kept if abs(kept - command) > 0.01 else command


class Drag(Level):
    """3 cm ahead of the human, to be the one who leads."""

    def goal(self, observation, kept):
        return kept + 0.03 * np.sign(self.moved) * (abs(self.moved) > STEADY)


class Brake(Level):
    """At most 12 mm in a step, so that the human has to wait."""

    def goal(self, observation, kept):
        command = observation[Seen.HAND_COMMAND]
        return command + np.clip(kept - command, -0.012, 0.012)


class GiveUp(Level):
    """Raises an error in its 60th step."""

    def goal(self, observation, kept):
        if self.step == 60:
            raise RuntimeError("no more")
        return kept


class HoldUntilStill(Level):
    """Does not move until the human waits."""

    def goal(self, observation, kept):
        return kept if self.rests > 2 else observation[Seen.HAND_COMMAND]


class Drift(Level):
    """Always a little higher."""

    def goal(self, observation, kept):
        return kept + min(0.0005 * self.step, 0.04)


class HighGain(Level):
    """Three times the seen difference."""

    def goal(self, observation, kept):
        command = observation[Seen.HAND_COMMAND]
        return command + 3.0 * (observation[Seen.HUMAN_END] - command)


class OverCorrect(Level):
    """Adds the seen tilt once more."""

    def goal(self, observation, kept):
        return kept + observation[Seen.HUMAN_END] - observation[Seen.ROBOT_END]


class FarLead(Level):
    """A period further ahead than level needs."""

    ahead = 3.0


class StallTop(Level):
    """Level until the human first rests; then it never moves again."""

    task = "intent"
    behind = (TWO_PEOPLE, "touch_level", "anticipate", "extrapolate")

    def reset(self, seed):
        super().reset(seed)
        self.stalled = False

    def goal(self, observation, kept):
        self.stalled = self.stalled or self.rests > 2
        return observation[Seen.HAND_COMMAND] if self.stalled else kept


class Sweep(Level):
    """At the top, up and down over all heights where a hurdle may be, knowing nothing."""

    task = "agree"
    behind = (TWO_PEOPLE, "anticipate", "extrapolate")
    size, period = 0.05, 12

    def reset(self, seed):
        super().reset(seed)
        self.begun = self.top = None

    def goal(self, observation, kept):
        if self.begun is None and self.rests > 2:
            self.begun, self.top = self.step, observation[Seen.HUMAN_END]
        after = -1 if self.begun is None else self.step - self.begun
        if not 0 <= after < SWEPT:
            return kept
        return self.top + self.size * math.sin(math.tau * after / self.period)


class SweepHalf(Sweep):
    """Half as far."""

    size = 0.025


class Sweep24(Sweep):
    """Half as fast."""

    period = 24
