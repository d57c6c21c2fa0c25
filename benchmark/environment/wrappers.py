"""The training view: Gymnasium wrappers that give a learner a state, and numbers near one."""

from collections.abc import Iterator
from typing import Any, Final

import gymnasium
import numpy as np
from colift.agents.agent import Action, Observation, RobotObservation
from colift.agents.senses import HEIGHT_BOUND
from colift.agents.submissions.network.policy import CORRECTION, FIXED, Senses, line, scales
from colift.agents.submissions.training_view import Single, scaled, unscaled
from colift.base.errors import InputError
from colift.benchmark.environment.drawing import ANY, DRAW
from colift.benchmark.environment.rewards import SCORE
from colift.benchmark.environment.single import RobotEnv
from gymnasium.spaces import Box
from gymnasium.utils import RecordConstructorArgs

STEPS: Final = 20
"""Steps of the human's motion that a learner sees: 2 s, a stroke."""

APART: Final = 2 * HEIGHT_BOUND
"""Bound of a difference of two heights [m]."""


class History(gymnasium.Wrapper[Observation, Action, Observation, Action], RecordConstructorArgs):
    """Observations with the past, since the five numbers of a step alone are not a state.

    An observation is the inputs of :class:`.Senses`, in metres: four heights, relative to the
    human's end, and the changes of the command and of the human's end in the last steps.

    Parameters
    ----------
    env
        :class:`.RobotEnv`, also inside wrappers that do not change observations.
    steps
        Steps of the human's motion, at least 1.
    """

    def __init__(self, env: gymnasium.Env[Observation, Action], steps: int = STEPS) -> None:
        RecordConstructorArgs.__init__(self, steps=steps)
        gymnasium.Wrapper.__init__(self, env)
        if isinstance(steps, bool) or not isinstance(steps, int) or steps < 1:
            raise InputError(f"steps must be a whole number of at least 1, got {steps!r}")
        shape = env.observation_space.shape
        if shape != (len(RobotObservation),):
            raise InputError(f"History takes the robot's five numbers, got observations {shape}")
        self._senses = Senses(steps)
        self.observation_space = Box(-APART, APART, (FIXED + steps,), np.float64)

    def reset(
        self, *, seed: int | None = None, options: dict[str, Any] | None = None
    ) -> tuple[Observation, dict[str, Any]]:
        """Begin an episode: before it, everything stood still."""
        observation, info = self.env.reset(seed=seed, options=options)
        self._senses.reset()
        return self._senses(observation), info

    def step(self, action: Action) -> tuple[Observation, float, bool, bool, dict[str, Any]]:
        """Advance by one control period."""
        observation, reward, terminated, truncated, info = self.env.step(action)
        return self._senses(observation), float(reward), terminated, truncated, info


class HoldingPace(
    gymnasium.Wrapper[Observation, Action, Observation, Action], RecordConstructorArgs
):
    """Actions as corrections [m] of the change that holds the human's last pace.

    Without a correction the hand goes where the human's end will be if it moves on as in the last
    step, as the policy ``extrapolate`` does: a learner begins with that instead of standing still.

    Parameters
    ----------
    env
        :class:`History`, also inside wrappers that do not change observations.
    """

    def __init__(self, env: gymnasium.Env[Observation, Action]) -> None:
        RecordConstructorArgs.__init__(self)
        gymnasium.Wrapper.__init__(self, env)
        if not any(isinstance(each, History) for each in _layers(env)):
            raise InputError("HoldingPace needs the past: wrap the environment in History first")
        self.action_space = Box(-CORRECTION, CORRECTION, (1,), np.float64)
        self._line = 0.0

    def reset(
        self, *, seed: int | None = None, options: dict[str, Any] | None = None
    ) -> tuple[Observation, dict[str, Any]]:
        """Begin an episode."""
        observation, info = self.env.reset(seed=seed, options=options)
        self._line = line(observation)
        return observation, info

    def step(self, action: Action) -> tuple[Observation, float, bool, bool, dict[str, Any]]:
        """Advance by one control period."""
        change = np.asarray(action, dtype=np.float64) + self._line
        observation, reward, terminated, truncated, info = self.env.step(change)
        self._line = line(observation)
        return observation, float(reward), terminated, truncated, info


class Scaled(gymnasium.Wrapper[Any, Any, Any, Any], RecordConstructorArgs):
    """Actions in [-1, 1], and observations by fixed scales, in single precision.

    Observations of :class:`History` are divided by the :func:`.scales` of the network, others by
    0.1 m, and the time by 10 s.

    Parameters
    ----------
    env
        :class:`.RobotEnv`, with or without the other wrappers.
    """

    def __init__(self, env: gymnasium.Env[Observation, Action]) -> None:
        RecordConstructorArgs.__init__(self)
        gymnasium.Wrapper.__init__(self, env)
        seen, done = env.observation_space, env.action_space
        assert isinstance(seen, Box)
        assert isinstance(done, Box)
        size = seen.shape[0]
        past = any(isinstance(each, History) for each in _layers(env))
        self._scales = scales(size - FIXED) if past else np.array([0.1] * (size - 1) + [10.0])
        self._largest = float(done.high[0])
        low, high = seen.low / self._scales, seen.high / self._scales
        self.observation_space = Box(low.astype(np.float32), high.astype(np.float32))
        self.action_space = Box(-1.0, 1.0, done.shape, np.float32)

    def reset(
        self, *, seed: int | None = None, options: dict[str, Any] | None = None
    ) -> tuple[Single, dict[str, Any]]:
        """Begin an episode."""
        observation, info = self.env.reset(seed=seed, options=options)
        return scaled(observation, self._scales), info

    def step(self, action: Single) -> tuple[Single, float, bool, bool, dict[str, Any]]:
        """Advance by one control period; actions beyond the range are clipped."""
        change = unscaled(action, self._largest)
        observation, reward, terminated, truncated, info = self.env.step(change)
        return scaled(observation, self._scales), float(reward), terminated, truncated, info


def training_view(
    env: gymnasium.Env[Observation, Action], *, steps: int = STEPS, pace: bool = True
) -> gymnasium.Env[Single, Single]:
    """Return the environment with the past, scaled to numbers near one.

    A wrapper for ``gymnasium.make_vec(..., wrappers=[training_view])``.

    Parameters
    ----------
    env
        :class:`.RobotEnv`.
    steps
        Steps of :class:`History`.
    pace
        Whether actions are corrections, see :class:`HoldingPace`.
    """
    seen: gymnasium.Env[Observation, Action] = History(env, steps)
    return Scaled(HoldingPace(seen) if pace else seen)


def training_env(
    behaviour: str = ANY,
    subject: str = DRAW,
    *,
    reward: str = SCORE,
    steps: int = STEPS,
    pace: bool = True,
    **settings: Any,
) -> gymnasium.Env[Single, Single]:
    """Return the robot's side of the lift in the form that suits learners best.

    Parameters
    ----------
    behaviour, subject, reward
        As for :func:`.parallel_env`, with other defaults: a new person and any behaviour at each
        reset, and the reward of the score.
    steps, pace
        As for :func:`training_view`.
    settings
        ``control_period``, ``latency`` [s] and ``render_mode``.

    Raises
    ------
    InputError
        As :class:`.RobotEnv`.
    """
    made = RobotEnv(behaviour=behaviour, subject=subject, reward=reward, **settings)
    return training_view(made, steps=steps, pace=pace)


def _layers(env: gymnasium.Env[Any, Any]) -> Iterator[gymnasium.Env[Any, Any]]:
    """Yield an environment and those inside it."""
    while isinstance(env, gymnasium.Wrapper):
        yield env
        env = env.env
    yield env
