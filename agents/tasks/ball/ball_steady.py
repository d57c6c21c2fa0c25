"""The ball by a fixed controller, whatever the person does."""

from dataclasses import dataclass
from typing import ClassVar

import numpy as np
from colift.agents.agent import Action, Observation
from colift.agents.ranges import NotNegative, check_ranges
from colift.agents.tasks.ball.inclining import Inclining
from colift.agents.tasks.ball.observation import BallObservation


@dataclass(frozen=True, kw_only=True)
class BallSteadyParameters:
    """Parameters of :class:`BallSteady`."""

    place_gain: NotNegative = 0.5
    """Height difference per distance from the target [m/m]."""
    speed_gain: NotNegative = 0.225
    """Height difference per speed of the ball [s]."""
    steepest: NotNegative = 0.1
    """Largest height difference [m]."""

    def __post_init__(self) -> None:
        """Check the ranges; see :mod:`colift.agents.ranges`."""
        check_ranges(self)


class BallSteady:
    """Keeps level with the human, and adds a proportional-derivative controller of the ball.

    It does all of the steering from the seen place and speed, whatever the person does; if it does
    not know the target, it uses the middle of the table.
    """

    alone: ClassVar[bool] = True
    """It departs from level by its own knowledge alone, whatever the partner does."""

    def __init__(self, *, parameters: BallSteadyParameters | None = None) -> None:
        self._parameters = parameters or BallSteadyParameters()
        self._inclining = Inclining()

    def reset(self, seed: int) -> None:
        """Begin an episode."""
        self._inclining.reset()
        self._place: float | None = None

    def act(self, observation: Observation) -> Action:
        """Return the change of the command [m]."""
        self._inclining.observe(observation)
        parameters = self._parameters
        place = float(observation[BallObservation.BALL_PLACE])
        last = place if self._place is None else self._place
        self._place = place
        speed = (place - last) / self._inclining.period
        error = place - float(observation[BallObservation.TARGET_PLACE])
        difference = parameters.place_gain * error + parameters.speed_gain * speed
        limit = parameters.steepest
        difference = min(max(difference, -limit), limit)
        return np.array([self._inclining.change(observation, difference)])
