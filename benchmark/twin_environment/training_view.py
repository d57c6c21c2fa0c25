"""The training view of the twin: numbers near one with the past, and actions that correct a line.

It is that of :func:`.training_env`, for every task and for many lifts at a time.
"""

from collections.abc import Mapping
from functools import partial
from pathlib import Path
from typing import Any, Final, NamedTuple

import jax
import jax.numpy as jnp
import numpy as np
from colift.agents.senses import TOUCH
from colift.agents.submissions.network.policy import (
    CORRECTION,
    FIXED,
    Network,
    Past,
    line,
    past_before,
    scales,
    sensed,
)
from colift.benchmark.training.result import check_place, usable, write_network
from colift.benchmark.twin_environment.environment import ROBOT, State, TwinEnv
from colift.benchmark.twin_environment.spaces import Box

STEPS: Final = 20
"""Steps of the human's motion that a learner sees: 2 s, a stroke."""

REACH: Final = 0.1
"""Largest correction in a task with touch [m], whose robots depart from a level table."""


class Viewed(NamedTuple):
    """The state of an environment with the training view."""

    inner: State
    past: Past
    line: jax.Array
    """Change of the hand command [m] that holds the human's last pace."""


class TrainingView:
    """An environment of the twin in the form that suits learners best, in JaxMARL's conventions.

    The robot observes the inputs of a trained network (:func:`.sensed`), scaled to numbers near
    one: heights relative to the human's end, the changes of the last steps, and what else the task
    observes. Its action in [-1, 1] corrects the change that holds the human's last pace. Another
    agent sees and does what it does in the environment itself.

    Parameters
    ----------
    env
        The environment.
    steps
        Steps of the human's motion among the inputs.
    """

    def __init__(self, env: TwinEnv, steps: int = STEPS) -> None:
        task = env.twin.task
        more = [sense.scale for sense in (*TOUCH, *task.senses)] if task.touch else []
        self.more = 1.0 / np.array(more)
        self.env, self.steps, self.reach = env, steps, REACH if task.touch else CORRECTION
        self._scales = np.concatenate((scales(steps), self.more)).astype(np.float32)
        self.name, self.agents, self.num_agents = env.name, env.agents, env.num_agents
        self.max_steps = env.max_steps
        wide = np.full(FIXED + steps + len(more), np.inf, np.float32)
        self.observation_spaces = {**env.observation_spaces, ROBOT: Box(-wide, wide, wide.shape)}
        self.action_spaces = {**env.action_spaces, ROBOT: Box(-1.0, 1.0, (1,))}

    def observation_space(self, agent: str) -> Any:
        """Return the space of an agent's observations."""
        return self.observation_spaces[agent]

    def action_space(self, agent: str) -> Any:
        """Return the space of an agent's actions."""
        return self.action_spaces[agent]

    @partial(jax.jit, static_argnums=0)
    def reset(self, key: jax.Array) -> tuple[dict[str, jax.Array], Viewed]:
        """Return the agents' observations and the state of a lift that the key draws."""
        views, inner = self.env.reset(key)
        inputs, state = self._seen(inner, past_before(views[ROBOT], self.steps, jnp), views[ROBOT])
        return {**views, ROBOT: inputs}, state

    @partial(jax.jit, static_argnums=0)
    def step(
        self, key: jax.Array, state: Viewed, actions: dict[str, jax.Array]
    ) -> tuple[dict[str, jax.Array], Viewed, dict[str, Any], dict[str, Any], dict[str, Any]]:
        """Return observations, state, rewards, ends and information after a step."""
        correction = self.reach * jnp.clip(actions[ROBOT], -1.0, 1.0)
        done = {**actions, ROBOT: state.line + correction}
        views, inner, rewards, dones, infos = self.env.step(key, state.inner, done)
        new, over = views[ROBOT], dones["__all__"]
        before = past_before(new, self.steps, jnp)
        past = jax.tree.map(partial(jnp.where, over), before, state.past)
        inputs, state = self._seen(inner, past, new)
        return {**views, ROBOT: inputs}, state, rewards, dones, infos

    def _seen(self, inner: State, past: Past, view: jax.Array) -> tuple[jax.Array, Viewed]:
        past, inputs = sensed(past, view, jnp)
        return inputs / self._scales, Viewed(inner, past, line(inputs))

    @staticmethod
    def check_folder(folder: Path | str) -> None:
        """Refuse a folder to which :meth:`write` could not write, before anything is trained.

        Raises
        ------
        InputError
            If it is not a new or empty folder, or cannot be written.
        """
        check_place(Path(folder))

    def write(
        self, folder: Path | str, weights: Mapping[str, Any], *, name: str, trained_on: str
    ) -> Path:
        """Write a trained network as a submission, and return its folder.

        Parameters
        ----------
        folder
            A new or empty folder; :meth:`check_folder` tells before a training.
        weights
            ``w0``, ``b0``, ``w1``, ``b1`` and so on, of shapes (outputs, inputs) and (outputs,):
            tanh units, the last with one output; its tanh is the action. ``linear`` (inputs,), a
            path beside the layers, may be missing.
        name, trained_on
            Entries of the manifest.

        Raises
        ------
        InputError
            If the weights do not fit together, or as :meth:`check_folder`.
        """
        self.check_folder(folder)
        own = {} if not self.more.size else {"more": self.more, "reach": np.array([self.reach])}
        linear = {"linear": np.zeros(len(self._scales))}
        whole = {**linear, **{key: np.asarray(weights[key]) for key in weights}, **own}
        usable(whole, Network)
        about = {
            "name": name,
            "description": "A straight line through the human's last heights, corrected by a "
            "network.",
            "trained_on": trained_on,
        }
        return write_network(Path(folder), whole, about)
