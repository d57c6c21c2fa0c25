"""The paper's reactive controller: a learned follower (section III.A)."""

from collections.abc import Sequence

import numpy as np
from colift.agents.agent import Action, Observation, RobotObservation
from colift.agents.control.q_learning import (
    ACTIONS,
    Q_PARAMETERS,
    QParameters,
    learned_table,
    state_of,
)


class Reactive:
    """Follows by steps of 2 cm, learned by Q-learning (Thobbi, Gu, Sheng 2011, section III.A).

    The state is the human's end from motion capture minus the hand from its encoders. With a hand
    height as old as the human's, the steps would overshoot and never come to rest.
    """

    def __init__(
        self,
        *,
        parameters: QParameters = Q_PARAMETERS,
        table: Sequence[Sequence[float]] | None = None,
    ) -> None:
        self._parameters = parameters
        self._greedy = np.argmax(learned_table() if table is None else np.array(table), axis=1)

    def reset(self, seed: int) -> None:
        """Begin an episode; there is nothing to prepare."""

    def act(self, observation: Observation) -> Action:
        """Return the learned step [m] for the height difference."""
        return np.array([self.step(observation)])

    def step(self, observation: Observation) -> float:
        """Return the greedy action in the observed state [m]."""
        difference = (
            observation[RobotObservation.HUMAN_END] - observation[RobotObservation.HAND_HEIGHT]
        )
        action = self._greedy[state_of(float(difference), self._parameters)]
        return ACTIONS[action] * self._parameters.position_step
