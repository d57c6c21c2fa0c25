"""The Gymnasium view: the robot is the agent, the scripted human is part of the world."""

from typing import Any

import gymnasium
import numpy as np
from colift.agents.agent import Action, Agent, Observation
from colift.base.errors import InputError
from colift.benchmark.environment.moment import Moment
from colift.benchmark.environment.parallel import parallel_env
from colift.benchmark.environment.settings import HUMAN, ROBOT, SETTINGS, check_options
from colift.benchmark.episode.seat import HUMANS
from gymnasium.spaces import Space
from numpy.typing import NDArray


class RobotEnv(gymnasium.Env[Observation, Action]):
    """The lift for one agent, the robot: ``gymnasium.make("colift/Lift-v0")``.

    Spaces and rewards are the robot's of :class:`.ParallelLift`.

    Parameters
    ----------
    render_mode
        ``None``, ``"rgb_array"`` or ``"human"``.
    settings
        Those of :func:`.parallel_env`; ``partner`` is a robot here.

    Raises
    ------
    InputError
        If there is no such setting, or as :func:`.parallel_env`.
    """

    metadata: dict[str, Any] = {  # noqa: RUF012 - Gymnasium's convention
        "render_modes": ["human", "rgb_array"],
        "render_fps": 10,
    }

    def __init__(self, render_mode: str | None = None, **settings: Any) -> None:
        unknown = settings.keys() - set(SETTINGS)
        if unknown:
            known = ", ".join(SETTINGS)
            raise InputError(f"no such setting: {', '.join(sorted(unknown))}; known: {known}")
        if settings.get("partner") in [*HUMANS]:
            raise InputError(
                f"partner must be a robot here, got {settings['partner']!r}: colift.parallel_env "
                "has lifts of two humans"
            )
        self._env = parallel_env(render_mode=render_mode, **settings)
        self.render_mode = render_mode
        self.observation_space: Space[Any] = self._env.observation_space(ROBOT)
        self.action_space: Space[Any] = self._env.action_space(ROBOT)
        self._human: Agent | None = None

    def reset(
        self, *, seed: int | None = None, options: dict[str, Any] | None = None
    ) -> tuple[Observation, dict[str, Any]]:
        """Begin an episode, see :meth:`.ParallelLift.reset`.

        Raises
        ------
        InputError
            If there are options: there is nothing that they could change.
        """
        check_options(options, others=False)
        super().reset(seed=seed)
        return self._begin(*self._env.reset(seed=seed))

    def _begin(
        self, observations: dict[str, Observation], infos: dict[str, dict[str, Any]]
    ) -> tuple[Observation, dict[str, Any]]:
        """Take the human of the episode, and return the robot's part."""
        self._human = self._env.scripted_human()
        self._human_observation = observations[HUMAN]
        return observations[ROBOT], infos[ROBOT]

    def save(self) -> Moment:
        """Return the present moment of the episode; see :meth:`.ParallelLift.save`."""
        return self._env.save()

    def restore(self, moment: Moment) -> tuple[Observation, dict[str, Any]]:
        """Return to a moment, with its human; see :meth:`.ParallelLift.restore`."""
        return self._begin(*self._env.restore(moment))

    def __getstate__(self) -> dict[str, Any]:
        """Return what a copy has; its human is made anew."""
        return {**self.__dict__, "_human": self._human is not None}

    def __setstate__(self, state: dict[str, Any]) -> None:
        """Go on as the original of this copy."""
        begun = state.pop("_human")
        self.__dict__.update(state, _human=None)
        if begun:
            self.restore(self.save())

    def step(self, action: Action) -> tuple[Observation, float, bool, bool, dict[str, Any]]:
        """Advance by one control period, see :meth:`.ParallelLift.step`.

        Raises
        ------
        ValueError
            If the action is of the wrong shape or not finite.
        RuntimeError
            If the episode is over, or none has begun.
        """
        if self._human is None:
            raise RuntimeError("the episode has not begun: call reset() first")
        human = self._human.act(self._human_observation)
        observations, rewards, terminated, truncated, infos = self._env.step(
            {HUMAN: human, ROBOT: action}
        )
        self._human_observation = observations[HUMAN]
        return (
            observations[ROBOT],
            rewards[ROBOT],
            terminated[ROBOT],
            truncated[ROBOT],
            infos[ROBOT],
        )

    def render(self) -> NDArray[np.uint8] | None:
        """Return a picture of the lift, or draw it in the window."""
        return self._env.render()

    def close(self) -> None:
        """Release the world and the scene."""
        self._env.close()
