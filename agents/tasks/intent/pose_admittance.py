"""Pose by admittance: the robot's end yields to the force that it feels."""

from dataclasses import dataclass

import numpy as np
from colift.agents.agent import Action, Observation
from colift.agents.control.predictor import DEFAULT_PERIOD
from colift.agents.ranges import Positive, check_ranges
from colift.agents.tasks.touch.observation import HapticObservation


@dataclass(frozen=True, kw_only=True)
class PoseByAdmittanceParameters:
    """Parameters of :class:`PoseByAdmittance`."""

    yielding: Positive = 0.84
    """Velocity per force [m/(s N)]. Tuned in factors of two, on seeds from 100000 on."""

    def __post_init__(self) -> None:
        """Check the ranges; see :mod:`colift.agents.ranges`."""
        check_ranges(self)


class PoseByAdmittance:
    """Moves with the force at its hands, and so follows wrists that mean to pitch the table.

    With the force F of the hands on the table beyond half of its weight, the velocity is

        v = -yielding F,

    the admittance of a pure damper, with which this tradition begins (K. Kosuge, H. Yoshida, T.
    Fukuda, "Dynamic control for robot-human collaboration", RO-MAN 1993). It has no model of the
    human's intention, and fails with people whose wrists show little of it.
    """

    def __init__(self, *, parameters: PoseByAdmittanceParameters | None = None) -> None:
        self._step = (parameters or PoseByAdmittanceParameters()).yielding * DEFAULT_PERIOD

    def reset(self, seed: int) -> None:
        """Begin an episode; nothing is kept."""

    def act(self, observation: Observation) -> Action:
        """Return the change of the command [m]."""
        return np.array([-self._step * observation[HapticObservation.FORCE]])
