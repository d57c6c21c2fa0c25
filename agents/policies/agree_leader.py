"""The rigid leader: takes the table to its own hurdle at once, whatever the human does."""

from typing import ClassVar

import numpy as np

from ..agent import Action, Observation
from ..agree.approach import Approach, OwnHurdleState
from ..observations import AgreeObservation
from .anticipate import Anticipate

EARLY = 0.3


class AgreeLeader:
    """Goes to its own hurdle as soon as the window opens; otherwise keeps level (`anticipate`)."""

    task: ClassVar[str] = "agree"

    def __init__(self) -> None:
        self._keeper = Anticipate()

    def reset(self, seed: int) -> None:
        """Begin an episode."""
        self._keeper.reset(seed)
        self._approach = Approach()
        self._hurdle = OwnHurdleState()

    def _mine(self, observation: Observation) -> bool:
        return bool(
            observation[AgreeObservation.VIA_GIVEN] > 0.5
            and observation[AgreeObservation.VIA_START] < EARLY
            and observation[AgreeObservation.VIA_STOP] > 0
            and not self._hurdle.passed
        )

    def act(self, observation: Observation) -> Action:
        """Return the change of the hand command [m]."""
        change = self._keeper.act(observation)
        self._hurdle.see(observation)
        command, time = (
            float(observation[i]) for i in (AgreeObservation.HAND_COMMAND, AgreeObservation.TIME)
        )
        goal = float(observation[AgreeObservation.VIA_HEIGHT])
        own = self._approach.change(command, goal, time)
        return np.array([own]) if self._mine(observation) else change
