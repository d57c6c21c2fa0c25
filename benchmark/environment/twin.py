"""The vector environment on the twin: thousands of lifts at once, for one agent, the robot."""

from typing import Any, Final

import jax
import jax.numpy as jnp
import numpy as np
from colift.agents.actions import action_limit
from colift.agents.agent import RobotObservation
from colift.base.errors import InputError
from colift.benchmark.environment.drawing import ANY, DRAW, make_drawing
from colift.benchmark.environment.rewards import REWARDS, SCORE, UNIT
from colift.benchmark.episode.metrics import FAILED_FRAME_MM
from colift.benchmark.episode.scenario import CONTROL_PERIOD, LATENCY
from colift.benchmark.robots.robot import DEFAULT_ROBOT
from colift.benchmark.tasks.level.task import LEVEL
from colift.benchmark.twin import playing as lifting
from colift.benchmark.twin.lifts import Lifts, draw_lifts, some
from colift.benchmark.twin.playing import Due, LiftState
from gymnasium.spaces import Box
from gymnasium.vector import AutoresetMode, VectorEnv
from gymnasium.vector.utils import batch_space
from numpy.typing import NDArray

Array = NDArray[Any]

POOL: Final = 1000
"""Number of lifts from which an environment draws by default; they are played again with other
actions."""


class TwinEnv(VectorEnv[Array, Array, Array]):
    """Lifts of the twin: ``gymnasium.make_vec("colift/Lift-twin-v0", num_envs=1024)``.

    Observations, actions and rewards are those of :class:`.RobotEnv`, in single precision. The
    lifts are those of the engine on the same scenarios and seeds, drawn at the first reset; the
    results are the twin's, and not scores.

    A lift that has ended begins anew with the next step, whose action is ignored (Gymnasium's
    ``AutoresetMode.NEXT_STEP``).

    Parameters
    ----------
    num_envs
        Number of lifts at once.
    behaviour, subject, control_period, latency
        As for :func:`.parallel_env`; by default behaviours and people are drawn.
    reward
        ``"task"`` or ``"score"``.
    pool
        Number of lifts from which to draw.

    Raises
    ------
    InputError
        If a setting is out of range, or the twin does not model the scenario.
    """

    metadata: dict[str, Any] = {  # noqa: RUF012 - Gymnasium's convention
        "autoreset_mode": AutoresetMode.NEXT_STEP
    }

    def __init__(
        self,
        num_envs: int = 1,
        *,
        behaviour: str = ANY,
        subject: str = DRAW,
        control_period: float = CONTROL_PERIOD,
        latency: float = LATENCY,
        reward: str = SCORE,
        pool: int = POOL,
    ) -> None:
        drawing = make_drawing(behaviour, subject, DEFAULT_ROBOT, control_period, latency)
        if drawing is None:
            raise InputError("the twin draws its lifts: behaviour 'any', subject 'draw', or both")
        if reward not in REWARDS:
            raise InputError(f"reward must be {' or '.join(map(repr, REWARDS))}, got {reward!r}")
        if num_envs < 1 or pool < 1:
            raise InputError(f"num_envs and pool must be at least 1, got {num_envs} and {pool}")
        self.num_envs = num_envs
        self._drawing, self._reward, self._size = drawing, reward, pool
        self._period = control_period
        low, high = (bound.astype(np.float32) for bound in LEVEL.robot_bounds())
        limit = action_limit(control_period)
        self.single_observation_space = Box(low, high)
        self.single_action_space = Box(-limit, limit, (1,), np.float32)
        self.observation_space = batch_space(self.single_observation_space, num_envs)
        self.action_space = batch_space(self.single_action_space, num_envs)
        self._lifts: Lifts | None = None

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
        if seed is not None or self._lifts is None:
            self._rng = np.random.default_rng(seed)
            seeds = self._rng.integers(2**62, size=self._size)
            self._lifts = draw_lifts(self._drawing.lift(int(each)) for each in seeds)
            self._steps = np.asarray(self._lifts.steps)
        self._chosen = self._rng.integers(self._size, size=self.num_envs)
        self._body = some(self._lifts, self._chosen)
        self._number = np.zeros(self.num_envs, np.int64)
        self._over = np.zeros(self.num_envs, bool)
        self._state = lifting.at_rest(self._body.size)
        return self._observation(), {}

    def step(self, actions: Array) -> tuple[Array, Array, Array, Array, dict[str, Any]]:
        """Advance all lifts by a control period.

        Raises
        ------
        ValueError
            If the actions are of the wrong shape or not finite.
        RuntimeError
            If no episode has begun.
        """
        if self._lifts is None:
            raise RuntimeError("no episode has begun: call reset() first")
        chosen = np.asarray(actions, np.float32)
        if chosen.shape != (self.num_envs, 1) or not np.isfinite(chosen).all():
            raise ValueError(f"actions must be {self.num_envs} finite numbers (n, 1)")
        begun, started = ~self._over, self._over
        state, level, far, drop = _advance(
            self._state, self._body, self._due(), jnp.asarray(chosen[:, 0])
        )
        self._number = np.where(begun, self._number + 1, 0)
        terminated = np.asarray(drop) & begun
        truncated = (self._number >= self._steps[self._chosen]) & begun & ~terminated
        rewards = np.asarray(level if self._reward == SCORE else far, np.float64)
        if self._reward == SCORE:
            left = (self._steps[self._chosen] - self._number) * (FAILED_FRAME_MM / 1000) ** 2 / UNIT
            rewards = rewards - np.where(terminated, left, 0.0)
        self._state = state
        if started.any():
            self._begin(started)
        self._over = terminated | truncated
        return self._observation(), np.where(begun, rewards, 0.0), terminated, truncated, {}

    def _begin(self, started: NDArray[np.bool_]) -> None:
        """Draw new lifts in the places of those that have ended."""
        assert self._lifts is not None
        drawn = self._rng.integers(self._size, size=self.num_envs)
        self._chosen = np.where(started, drawn, self._chosen)
        self._body = some(self._lifts, self._chosen)
        self._state = _renewed(self._state, lifting.at_rest(self._body.size), jnp.asarray(started))

    def _due(self) -> Due:
        """Return the coming step's share of the lifts."""
        step = np.minimum(self._number, self._steps[self._chosen] - 1)
        share: Due = _due(self._body, jnp.asarray(step))
        return share

    def _observation(self) -> Array:
        """Return the robots' observations (n, 5)."""
        view = _observe(self._state, self._due().noise, self._body.latency, self._period)
        views = np.array(view).T
        views[:, RobotObservation.TIME] = self._number * self._period
        return views


@jax.jit
def _due(lifts: Lifts, step: jax.Array) -> Due:
    """Return each lift's own step of the lifts."""
    at = jnp.arange(lifts.size)
    return Due(
        reference=lifts.reference[step, :, at].T,
        seen_target=lifts.seen_target[step, at],
        noise=lifts.noise[step, :, at].T,
    )


_observe = jax.jit(lifting.observe, static_argnums=3)


@jax.jit
def _advance(
    state: LiftState, lifts: Lifts, due: Due, actions: jax.Array
) -> tuple[LiftState, jax.Array, jax.Array, jax.Array]:
    """Return the lifts after a step, both rewards, and whether each was dropped."""
    state, frames = lifting.control_step(state, lifts.body, due, actions)
    size = lifts.reference.shape[1]
    return (
        state,
        -frames.squares() / size / UNIT,
        -jnp.abs(state.plant.differences[0]),
        lifting.dropped(state, size),
    )


@jax.jit
def _renewed(state: LiftState, fresh: LiftState, started: jax.Array) -> LiftState:
    """Return the lifts, some of them at rest again."""

    def chosen(new: jax.Array, old: jax.Array) -> jax.Array:
        return jnp.where(started, new, old) if new.ndim else old

    return jax.tree.map(chosen, fresh, state)  # type: ignore[no-any-return]
