"""The ball left to the human: the table is kept level, and the ball is slowed down."""

from dataclasses import dataclass
from typing import ClassVar

import numpy as np
from colift.agents.agent import Action, Observation
from colift.agents.ranges import NotNegative, check_ranges
from colift.agents.tasks.ball.tracking import Tracking


@dataclass(frozen=True, kw_only=True)
class BallCalmParameters:
    """Parameters of :class:`BallCalm`."""

    calming: NotNegative = 0.4
    """Height difference against the ball's motion, per speed [s]."""
    steepest: NotNegative = 0.08
    """Largest height difference [m]."""

    def __post_init__(self) -> None:
        """Check the ranges; see :mod:`colift.agents.ranges`."""
        check_ranges(self)


class BallCalm:
    """Keeps level with the human, and inclines the table against the ball's speed.

    It never loses the ball, but leaves it to the human to bring the ball to its target.
    """

    alone: ClassVar[bool] = True
    """It departs from level by its own knowledge alone, whatever the partner does."""

    def __init__(self, *, parameters: BallCalmParameters | None = None) -> None:
        self._parameters = parameters or BallCalmParameters()
        self._tracking = Tracking()

    def reset(self, seed: int) -> None:
        """Begin an episode."""
        self._tracking.reset()

    def act(self, observation: Observation) -> Action:
        """Return the change of the command [m]."""
        tracking, limit = self._tracking, self._parameters.steepest
        tracking.observe(observation)
        difference = self._parameters.calming * tracking.sample[1]
        difference = min(max(difference, -limit), limit)
        return np.array([tracking.inclining.change(observation, difference)])
