"""Control of the hand by a recurrent network that remembers the lifts of a session."""

from typing import Any, Final

import numpy as np
from colift.agents.agent import Action, Observation, RobotObservation
from colift.agents.control.portable import PORTABLE, ArrayFunctions
from colift.agents.control.recurrent import INPUTS, GatedNetwork, Memory, act, memory_at_rest

SESSION_INPUTS: Final = INPUTS + 1
"""Inputs of the network: those of :func:`.recurrent.act`, and the time since the lift began."""


def act_in_session(
    network: GatedNetwork,
    memory: Memory,
    observation: Any,
    functions: ArrayFunctions,
    told: tuple[Any, ...] = (),
) -> tuple[Memory, Any]:
    """Return memory after a step, and change of the command [m]; see :func:`.recurrent.act`.

    ``told`` are more inputs, of a network that is told more than a policy: arrays (k, ...).
    """
    time = 0.2 * observation[RobotObservation.TIME :] - 1.0
    inputs = functions.join((time, *told)) if told else time
    return act(network, memory, observation, functions, inputs)


def next_lift(memory: Memory) -> Memory:
    """Return the memory at the beginning of the next lift: only the units are kept."""
    zero = 0.0 * memory.height
    return Memory(memory.units, zero, zero, zero, zero)


class SessionController:
    """The control law of :class:`.Acquainted` with a given network.

    Parameters
    ----------
    network
        The weights.
    remember
        Whether the units are kept from lift to lift.
    """

    def __init__(self, network: GatedNetwork, *, remember: bool = True) -> None:
        self._network, self._remember = network, remember
        self._internals: dict[str, float] = {}
        self.begin_session()

    def begin_session(self) -> None:
        """Begin with a new person."""
        self._memory = memory_at_rest(self._network)

    @property
    def units(self) -> Any:
        """(u,) the network's units now."""
        return self._memory.units

    def reset(self, seed: int) -> None:
        """Begin a lift."""
        if not self._remember:
            self.begin_session()
        self._memory = next_lift(self._memory)

    def act(self, observation: Observation) -> Action:
        """Return the change of the command [m]."""
        observation = np.asarray(observation, dtype=np.float64)
        self._memory, change = act_in_session(self._network, self._memory, observation, PORTABLE)
        command = float(observation[RobotObservation.HAND_COMMAND] + change)
        self._internals = {"prediction": command - self._memory.sag, "sag": self._memory.sag}
        return np.array([change])

    def internals(self) -> dict[str, float]:
        """Return the expected height of the human's end after the step, and the arms' sag [m]."""
        return self._internals
