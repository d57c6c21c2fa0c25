"""The ball by admittance: the robot yields to the torque of the human's wrists."""

from dataclasses import dataclass

import numpy as np
from colift.agents.agent import Action, Observation
from colift.agents.ranges import NotNegative, check_ranges
from colift.agents.tasks.ball.tracking import Tracking


@dataclass(frozen=True, kw_only=True)
class BallAdmittanceParameters:
    """Parameters of :class:`BallAdmittance`."""

    admittance: NotNegative = 1.4
    """Commanded height difference, relative to the one that the wrists seem to mean."""
    calming: NotNegative = 0.1
    """Height difference against the ball's motion, per speed [s]."""
    steepest: NotNegative = 0.034
    """Largest height difference [m]."""

    def __post_init__(self) -> None:
        """Check the ranges; see :mod:`colift.agents.ranges`."""
        check_ranges(self)


class BallAdmittance:
    """Inclines the table by a multiple of the pitch that the human's wrists seem to mean.

    The sensed force gives the torque of the wrists (:func:`.meant_by_wrists`). The gain is fixed:
    right for a person who shows half of what is wanted, too large for one who shows all of it, and
    too small for one who shows little. It uses no target, known or not.
    """

    def __init__(self, *, parameters: BallAdmittanceParameters | None = None) -> None:
        self._parameters = parameters or BallAdmittanceParameters()
        self._tracking = Tracking()

    def reset(self, seed: int) -> None:
        """Begin an episode."""
        self._tracking.reset()

    def act(self, observation: Observation) -> Action:
        """Return the change of the command [m]."""
        parameters, tracking = self._parameters, self._tracking
        tracking.observe(observation)
        difference = parameters.admittance * tracking.meant()
        difference += parameters.calming * tracking.sample[1]
        limit = parameters.steepest
        difference = min(max(difference, -limit), limit)
        return np.array([tracking.inclining.change(observation, difference)])
