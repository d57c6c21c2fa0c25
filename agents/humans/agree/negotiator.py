"""The person who has a hurdle to pass, and a partner who may have another."""

import math
from typing import Final, NamedTuple

import numpy as np
from colift.agents.agent import FRAME, HISTORY, Action, HumanObservation, Observation
from colift.agents.estimators.belief import GoalBelief
from colift.agents.humans import ScriptedHuman, Subject
from colift.agents.humans.agree.manner import AgreeingManner, agreeing_manner
from colift.agents.humans.agree.precedence import Precedence

PACE: Final = 8.0
"""omega, the natural frequency of a person's approach [rad/s]: a hurdle 50 mm away is passed after
some 0.4 s."""

RESTING: Final = 0.02
"""Speed of the common way below which it rests [m/s]."""

LIFTED: Final = 0.08
"""Height above which a rest is the common height [m]."""

APART: Final = 0.5
"""Probability from which the partner counts as going to a goal of its own."""


class Secret(NamedTuple):
    """A hurdle as its holder knows it."""

    height: float
    """Height to pass [m]."""
    start: float
    """When its window opens, from now [s]."""
    stop: float
    """When it closes, from now [s]."""
    given: float
    """1 if there is a hurdle; otherwise all four are 0."""


PRIVATE: Final = len(Secret._fields) + 1
"""Numbers of a :class:`Negotiator`'s observation before :class:`.HumanObservation`."""


def with_secret(view: Observation, secret: Secret, uncertainty: float) -> Observation:
    """Return the observation of a :class:`Negotiator`.

    Parameters
    ----------
    view
        The senses, :class:`.HumanObservation`.
    secret
        The person's own hurdle.
    uncertainty
        Standard deviation of the perceived speed of the far end [m/s]: the less a person knows
        about the partner, the larger it is.
    """
    return np.concatenate((secret, (uncertainty,), view))


class Negotiator:
    r"""Carries out the common way, with detours to a hurdle of its own and to the partner's goal.

    The observation is that of :func:`with_secret`; its target is the common way. The person infers
    the partner's goal from the seen far end (:class:`.GoalBelief`), a visual delay late and with
    the given uncertainty. In the person's turn (:class:`.Precedence`) the goal is the height of the
    person's hurdle; otherwise it is the common height plus ``trust`` times the partner's expected
    offset from it. With the stiffness s, the best response to a far end at z is

        s goal + (1 - s) z,

    the minimum of s (x - goal)^2 + (1 - s) (x - z)^2. The hand's offset d from the common way
    approaches it by the linear-quadratic regulator of a double integrator,

        d'' = omega^2 (response - way - d) - sqrt(2) omega d'.

    The hand has a person's noise, tremor and correction (:class:`.ScriptedHuman`); the answer to
    the felt force is the reflex of the body in the world.

    Parameters
    ----------
    subject
        The person.
    manner
        The person's manner; by default that of :func:`.agreeing_manner`.
    """

    def __init__(self, *, subject: Subject, manner: AgreeingManner[float] | None = None) -> None:
        self._hand = ScriptedHuman(subject=subject)
        self._manner = manner or agreeing_manner(subject)
        self._delay = round(subject.visual_delay / FRAME)

    def reset(self, seed: int) -> None:
        """Begin an episode; the noise comes from ``seed``."""
        self._hand.reset(seed)
        self._rng = np.random.default_rng((seed, 1))
        self._belief = GoalBelief()
        self._turn = Precedence(self._manner.patience, self._manner.insistence)
        self._offset = self._rate = self._far = 0.0
        self._own = [0.0] * (self._delay + HISTORY)
        self._common: float | None = None
        self._mine = False

    def act(self, observation: Observation) -> Action:
        """Return the hand's reference height [m] in each of the next n frames."""
        *own, self._uncertainty = observation[:PRIVATE].tolist()
        secret, view = Secret(*own), observation[PRIVATE:].copy()
        way = self._way(view)
        response = self._respond(secret, view, way)
        base = self._base(way)
        goal, damping = response - base[-1], math.sqrt(2.0) * PACE
        heights = []
        for height in base:
            self._rate += (PACE * PACE * (goal - self._offset) - damping * self._rate) * FRAME
            self._offset += self._rate * FRAME
            heights.append(height + self._offset)
        view[HumanObservation.TARGET] = heights
        return self._hand.act(view)

    def _way(self, view: Observation) -> list[float]:
        """Return the common way's height in each of the next n frames [m]."""
        way: list[float] = view[HumanObservation.TARGET].tolist()
        return way

    def _base(self, way: list[float]) -> list[float]:
        """Return the heights to which the offset is added, in each of the next n frames [m]."""
        return way

    def _respond(self, secret: Secret, view: Observation, way: list[float]) -> float:
        """Return the height to go to [m], the best response to the far end."""
        stiffness, turn = self._manner.stiffness, self._turn
        own, far = self._see(view, way)
        self._mine = False
        if self._common is None:
            return way[-1]
        if secret.given:
            apart = self._belief.own_goal > APART
            turn.see(secret.height, secret.start, own, far)
            period = len(way) * FRAME
            self._mine = turn.mine(secret.start, secret.stop, apart=apart, period=period)
        if self._mine:
            return stiffness * secret.height + (1 - stiffness) * far
        return self._along(self._common, way, far)

    def _see(self, view: Observation, way: list[float]) -> tuple[float, float]:
        """Update the belief by the seen ends; return their heights [m]."""
        frames = len(way)
        period = frames * FRAME
        own = view[HumanObservation.OWN_HEIGHT].tolist()
        new = [own[0]] * (frames - len(own)) + own[-frames:]
        self._own = (self._own + new)[-(self._delay + HISTORY) :]
        far = float(view[HumanObservation.OTHER_END][-1])
        before, self._far = self._far, far
        uncertainty = self._uncertainty
        noise = uncertainty * float(self._rng.standard_normal())
        if not self._at_rest(way):
            self._common = None
            self._belief.forget()
            return own[-1], far
        common = self._common = way[-1] if self._common is None else self._common
        seen, then = far + noise * period, self._own[-1 - self._delay]
        self._belief.update(before, seen, then, common, period, uncertainty)
        speed = abs(far - before) / period
        self._turn.serve(abs(far - common), abs(far - own[-1]), speed, period)
        return own[-1], far

    def _along(self, common: float, way: list[float], far: float) -> float:
        """Return the height to go to while it is not the person's turn [m]."""
        stiffness = self._manner.stiffness
        goal = common + self._manner.trust * self._belief.offset
        return stiffness * goal + (1 - stiffness) * far

    def _at_rest(self, way: list[float]) -> bool:
        """Return whether the common way rests above the ground."""
        return abs(way[-1] - way[0]) < RESTING * len(way) * FRAME and way[0] > LIFTED
