"""The agents at the robot's end in the fixed sets."""

from typing import Final

import numpy as np
from colift.agents.actions import action_limit
from colift.agents.agent import Action, Agent, Observation, RobotObservation
from colift.agents.humans import SecondPerson
from colift.benchmark.episode.scenario import CONTROL_PERIOD
from colift.benchmark.episode.seeding import derive_seed

FASTER: Final = 0.8
"""Excess of the gain of ``proportional`` over 1: its default is 1.8."""

NOISE: Final = 0.2
"""Standard deviation of the gain's relative error in a step: enough to see other actions too."""


class Follower:
    """Follows the human somewhere between ``copy`` and ``proportional``, with a noisy gain.

    With u drawn for the lift and e for the step,

        change = (1 + 0.8 u) (1 + 0.2 e) (human - (u hand + (1 - u) command)),

    clipped to the hands' speed: u = 0 is ``copy``, which corrects its command, and u = 1
    ``proportional``, which corrects its hand. It predicts nothing.

    Parameters
    ----------
    seed
        The lift's seed.
    """

    def __init__(self, seed: int) -> None:
        self._seed = derive_seed(seed, "set/follow")

    def reset(self, seed: int) -> None:
        """Begin an episode; it follows from the lift's own seed."""
        self._rng = np.random.default_rng(self._seed)
        self._share = float(self._rng.random())

    def act(self, observation: Observation) -> Action:
        """Return the change of the hand command [m]."""
        share, limit = self._share, action_limit(CONTROL_PERIOD)
        own = (
            share * observation[RobotObservation.HAND_HEIGHT]
            + (1 - share) * observation[RobotObservation.HAND_COMMAND]
        )
        gain = (1 + FASTER * share) * (1 + NOISE * self._rng.standard_normal())
        change = gain * float(observation[RobotObservation.HUMAN_END] - own)
        return np.array([min(max(change, -limit), limit)])


class Clipped:
    """An agent whose changes of the command are clipped to the hands' speed, as in the lift.

    Parameters
    ----------
    agent
        The agent.
    """

    def __init__(self, agent: Agent) -> None:
        self._agent = agent

    def reset(self, seed: int) -> None:
        """Begin an episode."""
        self._agent.reset(seed)

    def act(self, observation: Observation) -> Action:
        """Return the change of the hand command [m]."""
        limit = action_limit(CONTROL_PERIOD)
        return np.clip(self._agent.act(observation), -limit, limit)


class SeededPartner:
    """The second of two people, with noise from the lift's own seed.

    Parameters
    ----------
    seed
        The lift's seed.
    """

    def __init__(self, seed: int) -> None:
        self._seed = derive_seed(seed, "set/human")
        self._partner = SecondPerson()

    def reset(self, seed: int) -> None:
        """Begin an episode; it follows from the lift's own seed."""
        self._partner.reset(self._seed)

    def act(self, observation: Observation) -> Action:
        """Return the hand's reference height in each frame of the step [m]."""
        return self._partner.act(observation)
