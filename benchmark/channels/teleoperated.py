"""A policy behind a channel, as the agent at the robot's end."""

import math
from typing import Final

import numpy as np
from colift.agents.actions import checked_action
from colift.agents.agent import Action, Agent, Observation, Printing, RobotObservation
from colift.base.errors import InputError
from colift.benchmark.channels.channel import Channel
from colift.benchmark.channels.schedule import channel_seed, schedule
from colift.benchmark.episode.scenario import Scenario

ANSWERED: Final = "answered"
"""The internal with the step of the observation that a command answers; NaN if there is none."""


class Teleoperated:
    """The robot's side of a channel, with the policy at the other side.

    A message to the robot is a set-point, independent of lost messages: the command that the policy
    saw, plus its action a. In step k the robot takes the newest answer, to observation i, as a
    change of its present command u,

        a_k = a - (u_k - u_i),

    and holds its command, a_k = 0, if there is no newer answer than before. The seat clips a_k to
    the speed of the hands, like any action. Without delay a_k is a, to the bit.

    The policy's own internals are not recorded; the only one is :data:`ANSWERED`.

    Parameters
    ----------
    policy
        The policy; if it is in a sandbox, the channel is outside.
    channel
        The channel.
    frames
        Frames per step.
    seed
        See :func:`.channel_seed`.
    """

    def __init__(self, policy: Agent, channel: Channel, *, frames: int, seed: int) -> None:
        self._policy = policy
        self._channel, self._frames, self._seed = channel, frames, seed

    def reset(self, seed: int) -> None:
        """Begin an episode: no message is on its way."""
        self._policy.reset(seed)
        self._turns = schedule(self._channel, self._frames, self._seed)
        self._observations: list[Observation] = []
        self._actions: dict[int, float] = {}
        self._answered: int | None = None

    def act(self, observation: Observation) -> Action:
        """Return the change of the command by the newest answer [m].

        Raises
        ------
        ActionError
            If an action of the policy cannot be carried out.
        """
        self._observations.append(observation)
        turn = next(self._turns)
        for number in turn.seen:
            action = self._policy.act(self._observations[number].copy())
            [self._actions[number]] = checked_action("robot", action, 1)
        self._answered = turn.answered
        if turn.answered is None:
            return np.zeros(1)
        then = self._observations[turn.answered][RobotObservation.HAND_COMMAND]
        since = observation[RobotObservation.HAND_COMMAND] - then
        return np.array([self._actions[turn.answered] - since])

    def internals(self) -> dict[str, float]:
        """Return :data:`ANSWERED`."""
        return {ANSWERED: math.nan if self._answered is None else float(self._answered)}

    @property
    def printed(self) -> str:
        """Return the end of the policy's output, if it is captured."""
        return self._policy.printed if isinstance(self._policy, Printing) else ""


def teleoperated(policy: Agent, channel: Channel, scenario: Scenario, seed: int) -> Teleoperated:
    """Return a policy behind a channel, for one episode.

    Raises
    ------
    InputError
        If a second person holds the robot's end.
    """
    if not scenario.seat.is_robot:
        raise InputError(f"a channel leads to a robot, not to the partner {scenario.partner!r}")
    frames, own = scenario.frames_per_step, channel_seed(scenario, seed)
    return Teleoperated(policy, channel, frames=frames, seed=own)
