"""The policy that never moves."""

import numpy as np
from colift.agents.agent import Action, Observation


class Hold:
    """Never moves: the robot stands still with the table in its hands."""

    def reset(self, seed: int) -> None:
        """Begin an episode; there is nothing to prepare."""

    def act(self, observation: Observation) -> Action:
        """Return no change of the hand command."""
        return np.zeros(1)
