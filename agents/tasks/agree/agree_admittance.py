"""Admittance: yielding to the force at the hands, with a spring to the robot's own hurdle."""

import math
from dataclasses import dataclass

import numpy as np
from colift.agents.agent import Action, Observation
from colift.agents.control.predictor import DEFAULT_PERIOD
from colift.agents.ranges import Positive, check_ranges
from colift.agents.tasks.agree.approach import HurdleWatch
from colift.agents.tasks.agree.observation import AgreeObservation


@dataclass(frozen=True, kw_only=True)
class AgreeAdmittanceParameters:
    """Parameters of :class:`AgreeAdmittance`, tuned by ``colift admit agree-v1 --tune``."""

    compliance: Positive = 0.49
    """c, speed of the hands per force [m/s/N]. A table inclined by 50 mm loads them with 0.8 N."""
    spring: Positive = 9.8
    """k, speed per distance from the robot's own hurdle [1/s]."""
    time: Positive = 0.085
    """Time constant of the speed [s], the virtual mass over the virtual damping."""
    early: Positive = 0.21
    """Time before its window opens at which the hurdle begins to attract the hands [s]."""

    def __post_init__(self) -> None:
        """Check the ranges; see :mod:`colift.agents.ranges`."""
        check_ranges(self)


class AgreeAdmittance:
    """Moves as a virtual mass, pulled by the human through the table and by a spring to its hurdle.

    With the felt force F, the height x of the hand and the height b of the hurdle, the speed
    approaches, with the time constant,

        -c F + k (b - x),

    the second term only during its own window and until the table has passed. If the human comes
    along, the force stays small and the hand arrives at b; if the human resists, both meet in
    between. It has no model of the human and does not use sight.
    """

    def __init__(self, *, parameters: AgreeAdmittanceParameters | None = None) -> None:
        self._parameters = parameters or AgreeAdmittanceParameters()

    def reset(self, seed: int) -> None:
        """Begin an episode at rest."""
        self._speed = 0.0
        self._hurdle = HurdleWatch()
        self._time: float | None = None

    def act(self, observation: Observation) -> Action:
        """Return the displacement of the virtual mass in this period [m]."""
        p = self._parameters
        self._hurdle.see(observation)
        time = float(observation[AgreeObservation.TIME])
        period = DEFAULT_PERIOD if self._time is None else time - self._time
        self._time = time
        wanted = -p.compliance * float(observation[AgreeObservation.FORCE])
        drawn = self._hurdle.is_open(p.early)
        if drawn:
            hand = float(observation[AgreeObservation.HAND_HEIGHT])
            wanted += p.spring * (self._hurdle.height - hand)
        self._speed -= math.expm1(-period / p.time) * (wanted - self._speed)
        self._internals = {"velocity": self._speed, "role": float(drawn)}
        return np.array([self._speed * period])

    def internals(self) -> dict[str, float]:
        """Return the velocity of the mass [m/s], and the role: 1 while the spring acts."""
        return self._internals
