"""Control of the hand by a recurrent network."""

import numpy as np
from colift.agents.agent import Action, Observation, RobotObservation
from colift.agents.control.portable import PORTABLE
from colift.agents.control.recurrent import GatedNetwork, act, memory_at_rest


class RecurrentController:
    """The control law of :class:`.Learned` with a given network.

    Parameters
    ----------
    network
        The weights.
    """

    def __init__(self, network: GatedNetwork) -> None:
        self._network = network
        self._internals: dict[str, float] = {}

    def reset(self, seed: int) -> None:
        """Begin an episode."""
        self._memory = memory_at_rest(self._network)

    def act(self, observation: Observation) -> Action:
        """Return the change of the command [m]."""
        observation = np.asarray(observation, dtype=np.float64)
        self._memory, change = act(self._network, self._memory, observation, PORTABLE)
        command = float(observation[RobotObservation.HAND_COMMAND] + change)
        self._internals = {"prediction": command - self._memory.sag, "sag": self._memory.sag}
        return np.array([change])

    def internals(self) -> dict[str, float]:
        """Return the expected height of the human's end after the step, and the arms' sag [m]."""
        return self._internals
