"""Admittance: yields to the force at its hands, and is drawn to its own hurdle by a spring."""

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from ..agent import Action, Observation
from ..agree.approach import OwnHurdleState
from ..observations import AgreeObservation
from .agree_leader import EARLY


@dataclass(frozen=True, kw_only=True)
class AgreeAdmittanceParameters:
    compliance: float = 0.7
    """Speed for a force [m/s/N]."""
    spring: float = 14.0
    """[1/s]"""
    mass: float = 0.1
    """Time constant [s]"""


class AgreeAdmittance:
    """x' = -c F + k (b - x) in the own window, low-passed."""

    task: ClassVar[str] = "agree"

    def __init__(self, *, parameters: AgreeAdmittanceParameters | None = None) -> None:
        self._parameters = parameters or AgreeAdmittanceParameters()

    def reset(self, seed: int) -> None:
        """Begin an episode."""
        self._speed = 0.0
        self._hurdle = OwnHurdleState()
        self._time = -0.1

    def act(self, observation: Observation) -> Action:
        """Return the change of the hand command [m]."""
        p = self._parameters
        self._hurdle.see(observation)
        time = float(observation[AgreeObservation.TIME])
        period, self._time = time - self._time, time
        wanted = -p.compliance * float(observation[AgreeObservation.FORCE])
        if (
            observation[AgreeObservation.VIA_GIVEN] > 0.5
            and observation[AgreeObservation.VIA_START] < EARLY
            and observation[AgreeObservation.VIA_STOP] > 0
            and not self._hurdle.passed
        ):
            gap = observation[AgreeObservation.VIA_HEIGHT] - observation[AgreeObservation.HAND_HEIGHT]
            wanted += p.spring * float(gap)
        self._speed += (wanted - self._speed) * min(period / p.mass, 1.0)
        return np.array([self._speed * period])
