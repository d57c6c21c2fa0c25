"""Control by a recurrent network that was learned through the twin."""

from dataclasses import dataclass
from functools import cache
from importlib.resources import files
from pathlib import Path

import numpy as np

from ..agent import Action, Observation, RobotObservation
from ..control.portable import PORTABLE
from ..control.recurrent import Network, act, read_network, rest


@dataclass(frozen=True, kw_only=True)
class LearnedParameters:
    """Parameters of :class:`Learned`."""

    model: str | None = None
    """File ``weights.npz`` of a folder written by ``colift train apg``; None: the shipped one."""


class RecurrentController:
    """The control law of :class:`Learned` with a given network.

    Parameters
    ----------
    network
        The weights.
    """

    def __init__(self, network: Network) -> None:
        self._network = network
        self._internals: dict[str, float] = {}

    def reset(self, seed: int) -> None:
        """Begin an episode."""
        self._memory = rest(self._network)

    def act(self, observation: Observation) -> Action:
        """Return the change of the command [m]."""
        observation = np.asarray(observation, dtype=np.float64)
        self._memory, change = act(self._network, self._memory, observation, PORTABLE)
        command = float(observation[RobotObservation.HAND_COMMAND] + change)
        self._internals = {"prediction": command - self._memory.sag, "sag": self._memory.sag}
        return np.array([change])

    def internals(self) -> dict[str, float]:
        """Return the height expected of the human's end after the step, and the arms' sag [m]."""
        return self._internals


class Learned(RecurrentController):
    """Corrects a straight line by a recurrent network, learned by gradients through lifts (ours).

    128 gated recurrent units remember the lift so far: how fast and how evenly this person moves,
    how noisy and how late the samples are, and how far the predictions have been off. The network
    was trained on the score itself, by gradients through whole lifts of the twin, with people of
    the benchmark's population and, for a third of the lifts, of much wider ranges. See
    :func:`.recurrent.act` for the equations and ``docs/background/learned.md`` for the training.
    """

    def __init__(self, *, parameters: LearnedParameters | None = None) -> None:
        model = (parameters or LearnedParameters()).model
        super().__init__(_shipped() if model is None else read_network(Path(model)))


@cache
def _shipped() -> Network:
    return read_network(files("colift.agents.control").joinpath("data", "learned.npz"))
