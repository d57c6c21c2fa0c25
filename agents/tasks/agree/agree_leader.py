"""The rigid leader: takes the table to its own hurdle at once, whatever the human does."""

from dataclasses import dataclass
from typing import ClassVar

import numpy as np
from colift.agents.agent import Action, Observation
from colift.agents.policies.anticipate import Anticipate
from colift.agents.ranges import Positive, check_ranges
from colift.agents.tasks.agree.approach import Approach, HurdleWatch
from colift.agents.tasks.agree.observation import AgreeObservation


@dataclass(frozen=True, kw_only=True)
class AgreeLeaderParameters:
    """Parameters of :class:`AgreeLeader`."""

    early: Positive = 0.357
    """Time before its window opens at which it sets out [s], to be there when the window opens."""
    pace: Positive = 11.76
    """Natural frequency of the approach [rad/s]."""

    def __post_init__(self) -> None:
        """Check the ranges; see :mod:`colift.agents.ranges`."""
        check_ranges(self)


class AgreeLeader:
    """Goes to its own hurdle as soon as the window opens, and stays until the table has passed.

    Neither the human's motion nor the force changes its way (:class:`.Approach`). Before and
    afterwards it keeps level by :class:`.Anticipate`.
    """

    alone: ClassVar[bool] = True
    """It departs from level by its own knowledge alone, whatever the partner does."""

    def __init__(self, *, parameters: AgreeLeaderParameters | None = None) -> None:
        self._parameters = parameters or AgreeLeaderParameters()
        self._keeper = Anticipate()

    def reset(self, seed: int) -> None:
        """Begin an episode."""
        self._keeper.reset(seed)
        self._approach = Approach(self._parameters.pace)
        self._hurdle = HurdleWatch()

    def act(self, observation: Observation) -> Action:
        """Return the change of the hand command [m]."""
        kept = self._keeper.act(observation)
        self._hurdle.see(observation)
        command = float(observation[AgreeObservation.HAND_COMMAND])
        time = float(observation[AgreeObservation.TIME])
        led = self._approach.change(command, self._hurdle.height, time)
        self._leads = self._hurdle.is_open(self._parameters.early) and self._in_turn()
        return np.array([led]) if self._leads else kept

    def internals(self) -> dict[str, float]:
        """Return the role: 1 on the way to its own hurdle, 0 while it keeps level."""
        return {"role": float(self._leads)}

    def _in_turn(self) -> bool:
        return True
