"""The vector environment on the twin: thousands of lifts at once, for one agent, the robot."""

from functools import partial
from typing import Any

import jax
import jax.numpy as jnp
import numpy as np
from colift.agents.actions import action_limit
from colift.base.errors import InputError
from colift.benchmark.environment.drawing import ANY, DRAW
from colift.benchmark.episode.scenario import CONTROL_PERIOD, LATENCY
from colift.benchmark.suites.catalogue import TASK
from colift.benchmark.twin.task_twin import TaskTwin
from colift.benchmark.twin_environment.environment import ADDED, ROBOT, State, TwinEnv
from colift.benchmark.twin_environment.made import LIFTS, check_counts, drawing_of, drawn_pool
from gymnasium.spaces import Box
from gymnasium.vector import AutoresetMode, VectorEnv
from gymnasium.vector.utils import batch_space
from numpy.typing import NDArray

Array = NDArray[Any]


class TwinVectorEnv(VectorEnv[Array, Array, Array]):
    """Lifts of the twin: ``gymnasium.make_vec("colift/Lift-twin-v0", num_envs=1024)``.

    Observations and actions are those of :class:`.RobotEnv`, in single precision; the reward is its
    ``reward="score"``. A step is one call of compiled code. The results are the twin's, and not
    scores.

    A lift that has ended begins anew with the next step, whose action is ignored (Gymnasium's
    ``AutoresetMode.NEXT_STEP``).

    Parameters
    ----------
    num_envs
        Number of lifts at once.
    task, behaviour, subject, control_period, latency
        As for :func:`.parallel_env`; by default behaviours and people are drawn.
    lifts, plans
        Number of lifts from which the environment draws, and of their plans (``colift.twin.make``).

    Raises
    ------
    InputError
        If a setting is out of range, or the twin does not model the task.
    """

    metadata: dict[str, Any] = {  # noqa: RUF012 - Gymnasium's convention
        "autoreset_mode": AutoresetMode.NEXT_STEP
    }

    def __init__(
        self,
        num_envs: int = 1,
        *,
        task: str = TASK,
        behaviour: str = ANY,
        subject: str = DRAW,
        control_period: float = CONTROL_PERIOD,
        latency: float = LATENCY,
        lifts: int = LIFTS,
        plans: int | None = None,
    ) -> None:
        if num_envs < 1:
            raise InputError(f"num_envs must be at least 1, got {num_envs}")
        check_counts(lifts, plans)
        self.num_envs, self._lifts, self._plans = num_envs, lifts, plans
        self._drawing = drawing_of(task, behaviour, subject, control_period, latency)
        self._twin = TaskTwin.of(self._drawing.scenarios)
        low, high = (bound.astype(np.float32) for bound in self._twin.task.robot_bounds())
        limit = action_limit(control_period)
        self.single_observation_space = Box(low, high)
        self.single_action_space = Box(-limit, limit, (1,), np.float32)
        self.observation_space = batch_space(self.single_observation_space, num_envs)
        self.action_space = batch_space(self.single_action_space, num_envs)
        self._state: State | None = None

    def reset(
        self, *, seed: int | None = None, options: dict[str, Any] | None = None
    ) -> tuple[Array, dict[str, Any]]:
        """Begin all lifts anew; the same ``seed`` draws the same lifts.

        Raises
        ------
        InputError
            If there are options: there is nothing that they could change.
        """
        if options:
            raise InputError(f"reset takes no options, got {', '.join(options)}")
        if seed is not None or self._state is None:
            self._rng = np.random.default_rng(seed)
            seed = int(self._rng.integers(2**62))
            self._env = TwinEnv(
                self._twin, drawn_pool(self._drawing, self._lifts, seed, self._plans)
            )
            self._step = jax.jit(partial(_step, self._env))
        self._state = self._env.begun(jnp.asarray(self._lanes()))
        self._over = np.zeros(self.num_envs, bool)
        views = self._env.views(
            self._state, self._env.pool.lifts(self._state.lane), self._env.share(self._state)
        )
        return np.asarray(views[ROBOT]).T.copy(), {}

    def step(self, actions: Array) -> tuple[Array, Array, Array, Array, dict[str, Any]]:
        """Advance all lifts by a control period.

        Raises
        ------
        ValueError
            If the actions are of the wrong shape or not finite.
        RuntimeError
            If no episode has begun.
        """
        if self._state is None:
            raise RuntimeError("no episode has begun: call reset() first")
        chosen = np.asarray(actions, np.float32)
        if chosen.shape != (self.num_envs, 1) or not np.isfinite(chosen).all():
            raise ValueError(f"actions must be {self.num_envs} finite numbers (n, 1)")
        self._state, found = self._step(self._state, chosen[:, 0], self._over, self._lanes())
        views, rewards, terminated, truncated = map(np.array, found)
        self._over = terminated | truncated
        return views, rewards.astype(np.float64), terminated, truncated, {}

    def _lanes(self) -> NDArray[np.int32]:
        """Return the lifts that come next."""
        return self._rng.integers(self._env.pool.size, size=self.num_envs, dtype=np.int32)


def _step(
    env: TwinEnv, state: State, actions: jax.Array, over: jax.Array, fresh: jax.Array
) -> tuple[State, tuple[jax.Array, ...]]:
    """Return lifts after a step, or at their beginning if they were over; and what is told."""
    played = env.advance(state, actions, jnp.zeros((ADDED, len(actions))))
    after = env.renewed(played.state, over, fresh)
    views = env.views(after, env.pool.lifts(after.lane), env.share(after))[ROBOT].T
    reward = jnp.where(over, 0.0, played.reward)
    return after, (views, reward, played.terminated & ~over, played.truncated & ~over)
