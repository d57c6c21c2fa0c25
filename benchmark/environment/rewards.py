"""Rewards: the task's own, or the share of each step in the score."""

from typing import Final, Protocol, runtime_checkable

import numpy as np
from colift.base.errors import InputError
from colift.benchmark.episode.lift import Lift
from colift.benchmark.episode.metrics import FAILED_FRAME_MM
from colift.benchmark.episode.reward_unit import UNIT
from colift.benchmark.episode.task import Task
from colift.benchmark.tasks.level.task import Level
from numpy.typing import NDArray

TASK_REWARD: Final = "task"
"""The task's own reward, see :meth:`.Task.rewards`."""

SCORE: Final = "score"
"""Reward by the square of the error in all frames of a step [cm2]; see :func:`score_rewards`."""

REWARDS: Final = (TASK_REWARD, SCORE)


@runtime_checkable
class Scored(Protocol):
    """A task whose score is not that of :class:`.Level`."""

    def squared_errors(self, lift: Lift) -> NDArray[np.float64]:
        """Return the square of the task's error in each frame of the step just made [m2]."""


def check_reward(reward: object, task: Task) -> None:
    """Raise an InputError if there is no such reward, or none for the task."""
    if reward not in REWARDS:
        raise InputError(f"reward must be {' or '.join(map(repr, REWARDS))}, got {reward!r}")
    own = isinstance(task, Scored) or getattr(type(task), "score", None) is Level.score
    if reward == SCORE and not own:
        raise InputError(
            f"task {task.name!r} has no reward 'score': it has a score of its own but "
            "no squared_errors(lift)"
        )


def score_rewards(lift: Lift) -> tuple[float, float]:
    r"""Return the rewards [cm2] of the human and of the robot for the step just made.

    With the heights Z1 and Z2 of the ends and the human's intended height Z* in the n frames t of
    the step,

    .. math::

        r_\text{robot} = -\frac1n \sum_t (Z_{1t} - Z_{2t})^2, \qquad
        r_\text{human} = r_\text{robot} - \frac1n \sum_t (Z_{1t} - Z^*_t)^2.

    The sum of the robot's rewards over the K steps of an episode is - K RMSE^2, since a drop costs
    :data:`.FAILED_FRAME_MM` for each remaining frame, as in the score: dropping the table never
    pays.
    """
    world, task, size = lift.world, lift.task, lift.frames_per_step
    human = np.array(world.human_end[-size:])
    target = lift.target[lift.frame - size : lift.frame]
    if isinstance(task, Scored):
        squares = task.squared_errors(lift)
    else:
        squares = (human - np.array(world.robot_end[-size:])) ** 2
    level, miss = float(squares.mean()), float(((human - target) ** 2).mean())
    if lift.dropped is not None:
        left = (lift.horizon - lift.frame) / size * (FAILED_FRAME_MM / 1000) ** 2
        level, miss = level + left, miss + left
    return -(level + miss) / UNIT, -level / UNIT
