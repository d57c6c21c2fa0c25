"""Rewards: the task's own, or the share of each step in the score."""

from typing import Any, Final, Protocol, cast, runtime_checkable

import numpy as np
from colift.agents.rules import SCALARS
from colift.base.errors import InputError
from colift.benchmark.episode.lift import Lift
from colift.benchmark.episode.reward_unit import UNIT
from colift.benchmark.episode.task import Task
from colift.benchmark.tasks.level.task import Level
from colift.benchmark.tasks.running_score import WORST, known_squares, square_at_end
from colift.benchmark.tasks.touch import Ends, Touch, gathered
from numpy.typing import NDArray

TASK_REWARD: Final = "task"
"""The task's own reward, see :meth:`.Task.rewards`."""

SCORE: Final = "score"
"""Reward by a step's share in the square of the score [cm2]; see :func:`score_rewards`."""

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
    known = isinstance(task, Scored | Touch) or getattr(type(task), "score", None) is Level.score
    if reward == SCORE and not known:
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

    In a task that is stated by rules (:class:`.Touch`) both get what the step adds to the square
    of the score, times K; an unfinished plan costs at the end. See :func:`.known_squares`.
    """
    world, task, size = lift.world, lift.task, lift.frames_per_step
    if isinstance(task, Touch):
        done = lift.done
        after = _whole_square(lift) if done else _known_square(lift, lift.frame)
        added = after - _known_square(lift, lift.frame - size)
        reward = -added * lift.horizon / size / UNIT
        return reward, reward
    human = np.array(world.human_end[-size:])
    target = lift.target[lift.frame - size : lift.frame]
    if isinstance(task, Scored):
        squares = task.squared_errors(lift)
    else:
        squares = (human - np.array(world.robot_end[-size:])) ** 2
    level, miss = float(squares.mean()), float(((human - target) ** 2).mean())
    if lift.dropped is not None:
        left = (lift.horizon - lift.frame) / size * WORST
        level, miss = level + left, miss + left
    return -(level + miss) / UNIT, -level / UNIT


def _known_square(lift: Lift, frames: int) -> float:
    """Return the part of the square of the score that is known after some frames [m2]."""
    task = cast(Touch, lift.task)
    if frames == 0:
        return 0.0
    squares = [
        float(gathered(each, stay)) if frames >= stay else WORST
        for each, stay in zip(_squares(lift, frames), task.stays, strict=True)
    ]
    known = known_squares(SCALARS, squares, task.stays)
    return task.error(SCALARS, lift.facts, known, lift.horizon)


def _whole_square(lift: Lift) -> float:
    """Return the square of the score of a lift that has ended [m2]; see :meth:`.Touch.rmse_mm`."""
    task, played = cast(Touch, lift.task), lift.frame
    squares = [
        float(gathered(each, stay))
        for each, stay in zip(_squares(lift, played), task.stays, strict=True)
    ]
    error = task.error(SCALARS, lift.facts, squares, played)
    missing = max(lift.horizon - played, task.unfinished(SCALARS, lift.drawn, lift))
    return float(square_at_end(error, played, missing))


def _squares(lift: Lift, frames: int) -> Any:
    """Return the squares of the error in the first frames, arrays (frames,) [m2]."""
    task, world = cast(Touch, lift.task), lift.world
    rolling = () if task.rolling is None else (world.ball_place,)
    read = (world.human_end, world.robot_end, *rolling)
    ends = [np.array(each[-lift.frame :][:frames]) for each in read]
    due = type(lift.due)(*(series[:frames] for series in lift.due)) if lift.due else ()
    return task.missed(cast(Any, np), due, Ends(*ends, *[0.0] * (3 - len(ends))))
