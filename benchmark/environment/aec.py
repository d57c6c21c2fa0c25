"""The AEC environment: human and robot in turn, the human first."""

import inspect
from collections.abc import Callable
from typing import Any, ParamSpec, TypeAlias

from colift.agents.actions import checked_action
from colift.agents.agent import Agent
from colift.benchmark.environment.parallel import parallel_env
from pettingzoo import AECEnv
from pettingzoo.utils import BaseWrapper, OrderEnforcingWrapper, parallel_to_aec

P = ParamSpec("P")
AEC: TypeAlias = AECEnv[str, Any, Any]
"""An environment of agents that take turns: agent-environment cycle."""


class CheckedTurns(BaseWrapper[str, Any, Any]):  # type: ignore[misc]
    """Checks the action of each agent in its own turn, before both are carried out."""

    def step(self, action: Any) -> None:
        """Take the action of the agent whose turn it is; None if its episode is over.

        Raises
        ------
        ValueError
            If the action is of the wrong shape or not finite.
        """
        agent = self.agent_selection
        if not (self.terminations[agent] or self.truncations[agent]):
            checked_action(agent, action, self.action_space(agent).shape[0])
        super().step(action)

    def scripted_human(self) -> Agent:
        """Return the agent that carries out the plan; see :meth:`.ParallelLift.scripted_human`."""
        human: Agent = self.unwrapped.scripted_human()
        return human


def _with_parameters_of(
    other: Callable[P, Any],
) -> Callable[[Callable[..., AEC]], Callable[P, AEC]]:
    """Return a decorator by which a function shows the parameters of another as its own."""

    def shown(function: Callable[..., AEC]) -> Callable[P, AEC]:
        function.__signature__ = inspect.signature(other)  # type: ignore[attr-defined]
        return function

    return shown


@_with_parameters_of(parallel_env)
def env(*values: Any, **settings: Any) -> AEC:
    """Return the AEC environment; its parameters are those of :func:`.parallel_env`."""
    return OrderEnforcingWrapper(raw_env(*values, **settings))


@_with_parameters_of(parallel_env)
def raw_env(*values: Any, **settings: Any) -> AEC:
    """Return the AEC environment of :func:`env` without a check of the order of calls."""
    return CheckedTurns(parallel_to_aec(parallel_env(*values, **settings)))
