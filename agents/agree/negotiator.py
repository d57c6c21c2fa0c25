"""The person who has a hurdle to pass, and a partner who may have another."""

import math
from typing import Final, NamedTuple

import numpy as np

from ..agent import FRAME, HISTORY, Action, HumanObservation, Observation
from ..humans import ScriptedHuman, Subject
from .belief import GoalBelief
from .manner import AgreeingManner, agreeing_manner
from .turn import Turn

PACE: Final = 8.0
"""omega, the natural frequency of the optimal approach [rad/s]: a hurdle 50 mm away is passed
after some 0.4 s."""

RESTING: Final = 0.02
"""Speed of the common way below which it rests [m/s]."""

LIFTED: Final = 0.08
"""Height above which a rest is the common height [m]."""

APART: Final = 0.5
"""Probability from which on the partner is taken to go to a goal of its own."""

PRIVATE: Final = 4
"""Numbers of a person's own hurdle, before the senses: height [m], opening and closing of its
window from now [s], and 1 if there is one."""


class OwnVia(NamedTuple):
    """The private numbers of an observation."""

    height: float
    start: float
    stop: float
    given: float


def with_via(view: Observation, own: OwnVia) -> Observation:
    """Return the observation of a :class:`Negotiator`: the own hurdle, then the senses."""
    return np.concatenate((own, view))


class Negotiator:
    r"""Carries the common way out, with a detour to the own hurdle and to the partner's goal.

    The observation is the own hurdle, then :class:`.HumanObservation`.

    Whom the far end belongs to is inferred from what is seen of it (:class:`.GoalBelief`), as late
    as the visual delay and with the person's uncertainty. The goal is the own height in the own
    turn (:class:`.Turn`), otherwise ``trust`` times the partner's expected goal. With the stiffness
    s, the best response to a far end at z is

        s goal + (1 - s) z,

    the minimum of s (x - goal)^2 + (1 - s) (x - z)^2. The offset d from the common way approaches it
    by the linear-quadratic regulator of a double integrator, d'' = w^2 (goal - d) - sqrt(2) w d'.
    The hand is a person's own, with noise, tremor and correction (:class:`.ScriptedHuman`).
    """

    def __init__(self, *, subject: Subject, manner: AgreeingManner | None = None) -> None:
        self._hand = ScriptedHuman(subject=subject)
        self._manner = manner or agreeing_manner(subject)
        self._delay = round(subject.visual_delay / FRAME)

    def reset(self, seed: int) -> None:
        """Begin an episode; the noise comes from ``seed``."""
        self._hand.reset(seed)
        self._rng = np.random.default_rng((seed, 1))
        self._belief = GoalBelief()
        self._turn = Turn(self._manner.patience, self._manner.insistence)
        self._offset = self._rate = 0.0
        self._own = [0.0] * (self._delay + HISTORY)
        self._far = 0.0
        self._mine = False
        self._common: float | None = None

    def act(self, observation: Observation) -> Action:
        """Return the hand's reference height [m] in each of the next n frames."""
        own, view = OwnVia(*observation[:PRIVATE].tolist()), observation[PRIVATE:].copy()
        way = self._way(view)
        target = self._goal(own, view, way)
        base = self._base(way)
        goal = target - base[-1]
        heights, damping = [], math.sqrt(2.0) * PACE
        for height in base:
            pull = PACE * PACE * (goal - self._offset) - damping * self._rate
            self._rate += pull * FRAME
            self._offset += self._rate * FRAME
            heights.append(height + self._offset)
        view[HumanObservation.TARGET] = heights
        return self._hand.act(view)

    def _way(self, view: Observation) -> list[float]:
        """Return the common way's height in each of the next n frames [m]."""
        way: list[float] = view[HumanObservation.TARGET].tolist()
        return way

    def _goal(self, own: OwnVia, view: Observation, way: list[float]) -> float:
        """Return the height to go to [m]: the best response to the far end."""
        manner, belief, turn = self._manner, self._belief, self._turn
        near = view[HumanObservation.OWN_HEIGHT].tolist()
        far = float(view[HumanObservation.OTHER_END][-1])
        period = len(way) * FRAME
        self._own = (self._own + near[-len(way) :])[-(self._delay + 2 * HISTORY) :]
        noise = manner.uncertainty * float(self._rng.standard_normal())
        if self._at_rest(way):
            self._common = common = way[-1] if self._common is None else self._common
            belief.update(
                self._far,
                far + noise * period,
                self._own[-1 - self._delay],
                common,
                period,
                manner.uncertainty,
            )
        else:
            belief.forget()
            self._common = common = None
        before, self._far = self._far, far
        self._mine = False
        if common is None:
            return way[-1]
        if own.given:
            apart = belief.own_goal > APART
            turn.see(own.height, own.start, near[-1], far)
            speed = abs(far - before) / period
            turn.serve(abs(far - common), abs(far - near[-1]), speed, period)
            self._mine = turn.mine(own.start, own.stop, apart=apart, period=period)
            if self._mine:
                return manner.stiffness * own.height + (1 - manner.stiffness) * far
        return self._along(common, way, far)

    def _base(self, way: list[float]) -> list[float]:
        """Return what the offset is from, in each of the next n frames [m]."""
        return way

    def _along(self, common: float, way: list[float], far: float) -> float:
        """Return the height to go to while it is not the own turn [m]."""
        manner = self._manner
        goal = common + manner.trust * self._belief.offset
        return manner.stiffness * goal + (1 - manner.stiffness) * far

    def _at_rest(self, way: list[float]) -> bool:
        """Return whether the common way rests above the ground."""
        return abs(way[-1] - way[0]) < RESTING * len(way) * FRAME and way[0] > LIFTED
