"""The policy that moves at random."""

from dataclasses import dataclass

import numpy as np
from colift.agents.agent import Action, Observation


@dataclass(frozen=True, kw_only=True)
class RandomParameters:
    """Parameters of :class:`Random`."""

    step: float = 0.02
    """Largest change of the hand command in one step, up or down [m]: the paper's position step."""


class Random:
    """Moves up or down at random, whatever the human does.

    A policy's seed is the same in every episode (it must not identify the episode); therefore the
    first observation, which carries the sensors' noise, is mixed into it.
    """

    def __init__(self, *, parameters: RandomParameters | None = None) -> None:
        self._parameters = parameters or RandomParameters()

    def reset(self, seed: int) -> None:
        """Begin an episode."""
        self._seed = seed
        self._rng: np.random.Generator | None = None

    def act(self, observation: Observation) -> Action:
        """Return a change drawn uniformly from [-step, step] [m]."""
        if self._rng is None:
            entropy = np.frombuffer(observation.tobytes(), dtype=np.uint32)
            self._rng = np.random.default_rng([self._seed, *entropy.tolist()])
        return self._rng.uniform(-self._parameters.step, self._parameters.step, 1)
