"""The negotiator: infers where the human is going, and goes first, gives way or follows."""

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from ..agent import Action, Observation
from ..agree.approach import Approach, OwnHurdleState
from ..agree.belief import BeliefParameters, GoalBelief
from ..estimators.touched_end import TouchedEnd
from ..observations import AgreeObservation
from .anticipate import Anticipate


@dataclass(frozen=True, kw_only=True)
class AgreeGameParameters:
    """Parameters of :class:`AgreeGame`."""

    early: float = 0.35
    """How long before its window opens it may set out [s]."""
    lead: float = 0.1
    """How far ahead the human's end is extrapolated when followed [s]."""
    apart: float = 0.65
    """Probability of a human's own goal from which on it is taken for one."""
    conflict: float = 0.0
    """How long the human goes elsewhere until the robot gives way [s]."""
    served: float = 0.25
    """How long the table rests at the human's goal until it is taken for passed [s]."""
    needed: float = 0.65
    """Time that a passage needs [s]."""
    pace: float = 8.0
    """Natural frequency of the approach [rad/s]."""
    belief: BeliefParameters = BeliefParameters(noise=0.04)


class AgreeGame:
    """Plays the game of two hurdles with a belief about the human's goal."""

    task: ClassVar[str] = "agree"

    def __init__(self, *, parameters: AgreeGameParameters | None = None) -> None:
        self._parameters = parameters or AgreeGameParameters()
        self._keeper = Anticipate()

    def reset(self, seed: int) -> None:
        """Begin an episode."""
        self._keeper.reset(seed)
        self._touch = TouchedEnd()
        self._approach = Approach(self._parameters.pace)
        self._hurdle = OwnHurdleState()
        self._belief = GoalBelief(self._parameters.belief)
        self._common: float | None = None
        self._still = self._conflict = self._rested = 0.0
        self._sag = 0.0
        self._last = (0.0, 0.0, 0.0)
        self._change = 0.0
        self._yielding = self._going = False

    def act(self, observation: Observation) -> Action:
        """Return the change of the hand command [m]."""
        p, touch, o = self._parameters, self._touch, AgreeObservation
        kept = float(self._keeper.act(observation)[0])
        self._hurdle.see(observation)
        touch.update(observation)
        time, hand, command = (
            float(observation[i]) for i in (o.TIME, o.HAND_HEIGHT, o.HAND_COMMAND)
        )
        before, mine, since = self._last
        period = time - since if time > since else 0.1
        self._last = touch.height, hand, time
        if abs(self._change) < 0.003:
            self._sag += 0.5 * (command - hand - self._sag)
        self._rest(period)
        if self._common is None:
            self._belief.forget()
        else:
            self._belief.update(before, touch.height, mine, self._common, period)
            kept = touch.height + p.lead * touch.velocity + self._sag - command
        own = self._approach.change(command, float(observation[o.VIA_HEIGHT]) + self._sag, time)
        going = self._decide(observation, hand, period)
        self._change = own if going else kept
        self._internals = {
            "goal": (self._common or 0.0) + self._belief.offset,
            "apart": self._belief.own_goal,
            "role": float(going),
            "yielding": float(self._yielding),
        }
        return np.array([self._change])

    def internals(self) -> dict[str, float]:
        """Return the human's expected goal [m], its probability, and whether it goes first."""
        return self._internals

    def _rest(self, period: float) -> None:
        """Note the height at which the human comes to rest first."""
        height, speed = self._touch.height, abs(self._touch.velocity)
        self._still = self._still + period if speed < 0.04 and height > 0.1 else 0.0
        if self._common is None and self._still >= 0.25:
            self._common = height
        if height < 0.06:
            self._common = None

    def _decide(self, observation: Observation, hand: float, period: float) -> bool:
        """Return whether to go to the own hurdle now."""
        p, o, belief, touch = self._parameters, AgreeObservation, self._belief, self._touch
        start, stop, via = (
            float(observation[i]) for i in (o.VIA_START, o.VIA_STOP, o.VIA_HEIGHT)
        )
        given = observation[o.VIA_GIVEN] > 0.5
        if not given or start > p.early or stop <= 0.0 or self._hurdle.passed:
            self._going = False
            return False
        common = touch.height if self._common is None else self._common
        elsewhere = (
            belief.own_goal > p.apart
            and abs(common + belief.offset - via) > 0.015
            and abs(touch.height - via) > 0.015
        )
        if not self._yielding:
            self._conflict = self._conflict + period if elsewhere else 0.0
            wait = p.conflict if self._going else 0.0
            if self._conflict > wait and stop > p.needed:
                self._yielding, self._rested = True, 0.0
        if self._yielding:
            resting = abs(touch.velocity) < 0.05 and abs(touch.height - hand) < 0.01
            self._rested = self._rested + period if resting else 0.0
            if self._rested >= p.served or stop <= p.needed or not elsewhere:
                self._yielding, self._conflict = False, -0.3
        self._going = not self._yielding
        return self._going
