"""The environment with one agent, in the conventions of gymnax."""

from functools import partial
from typing import Any

import jax
import jax.numpy as jnp
from colift.benchmark.twin_environment.environment import ROBOT, State, TwinEnv


class Single:
    """The robot's seat: ``reset(key, params)`` and ``step(key, state, action, params)``.

    Parameters
    ----------
    env
        An environment with one agent.
    ends
        1: a step returns observation, state, reward, done and information, as in gymnax 0.0.
        2: it returns whether the lift is terminated and whether it is truncated instead of one end,
        as in gymnax 1; an end is then always a termination.
    """

    default_params: None = None

    def __init__(self, env: TwinEnv, ends: int = 1) -> None:
        self.env, self.ends, self.name = env, ends, env.name

    @property
    def num_actions(self) -> int:
        """Numbers of an action."""
        return 1

    @partial(jax.jit, static_argnums=(0, 2))
    def reset(self, key: jax.Array, params: Any = None) -> tuple[jax.Array, State]:
        """Return observation and state of a lift that the key draws."""
        views, state = self.env.reset(key)
        return views[ROBOT], state

    @partial(jax.jit, static_argnums=(0, 4))
    def step(
        self, key: jax.Array, state: State, action: jax.Array, params: Any = None
    ) -> tuple[Any, ...]:
        """Return observation, state, reward, one or two ends, and information after a step."""
        views, state, rewards, dones, infos = self.env.step(key, state, {ROBOT: action})
        infos = {name: each[0] for name, each in infos.items()}
        done = dones["__all__"]
        ends = (done,) if self.ends == 1 else (done, jnp.zeros((), bool))
        return (views[ROBOT], state, rewards[ROBOT], *ends, infos)

    def observation_space(self, params: Any = None) -> Any:
        """Return the space of observations."""
        return self.env.observation_space(ROBOT)

    def action_space(self, params: Any = None) -> Any:
        """Return the space of actions."""
        return self.env.action_space(ROBOT)
