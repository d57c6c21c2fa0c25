"""The oracle of the ball: it knows the plan, the target, and the human's coming motion."""

from functools import cache
from typing import Final, NamedTuple

import numpy as np
from colift.agents.agent import FRAME, Action, Observation
from colift.agents.control.anticipation import ARM_LAG
from colift.agents.tasks.ball.ball_game import BallGame
from colift.benchmark.episode.lift import Lift
from colift.benchmark.episode.loop import Episode, run_episode
from colift.benchmark.world.ball import ROLLING
from colift.benchmark.world.table import GRAVITY, TABLE_LENGTH
from numpy.typing import NDArray

REHEARSALS: Final = 10
"""Number of rehearsals of an episode; the best one counts."""

NEARER: Final = 0.6
"""Part of the distance between the ball's last path and the target by which the next rehearsal
moves the path: a person who steers much answers a large change with a larger one."""

STEPS: Final = 15
"""Periods ahead over which commands are planned."""

BENDS: Final = 3.0
"""Cost of a bend of the command, relative to a distance of the ball of its size that lasts for a
frame. With a person who steers much, plans become unstable at a small cost."""

KEPT: Final = 0.97
"""Part of the human's deviation from the last rehearsal that is expected to last for a frame."""

Array = NDArray[np.float64]


class Law(NamedTuple):
    """The matrices of :func:`_law`."""

    reply: Array
    """(n, n) effect of the height difference in each coming frame on the ball's place in each
    [m/m]."""
    gain: Array
    """(n,) weight, in the next command, of the ball's distance from the path in each frame."""
    change: float
    """Weight, in the next command, of the last change of the command."""


@cache
def _law(frames: int) -> Law:
    """Return the matrices of the plan for periods of ``frames`` frames.

    The ball's place in the coming n frames is that on a level table plus ``reply`` d, with the
    height difference d = u - z1. The coming commands' changes from the present one minimise the
    squared distance from the path and :data:`BENDS` times their squared bends.
    """
    count = STEPS * frames
    time = np.arange(count)
    later = np.maximum(time[:, None] - time[None, :] + 0.5, 0.0) * (time[:, None] >= time[None, :])
    reply = -ROLLING * GRAVITY / TABLE_LENGTH * FRAME**2 * later
    lag = ARM_LAG / FRAME
    knots = np.arange(STEPS + 1)
    at = (time + 0.5 - lag) / frames
    ramps = np.stack([np.interp(at, knots, one) for one in np.eye(STEPS + 1)], axis=1)
    effect = reply @ ramps[:, 1:]
    bends = np.eye(STEPS) - 2 * np.eye(STEPS, k=-1) + np.eye(STEPS, k=-2)
    hessian = effect.T @ effect + BENDS * bends.T @ bends
    gain = np.linalg.solve(hessian, effect.T)[0]
    first = np.zeros(STEPS)
    first[0] = 1.0
    change = float(np.linalg.solve(hessian, BENDS * bends.T @ first)[0])
    return Law(reply, gain, change)


class Foreseeing:
    """Commands that best bring the ball along a path, with full knowledge of present and future.

    Parameters
    ----------
    lift
        The lift being played, whose true state is read.
    human
        (horizon,) height of the human's end in each frame [m], as it was in the last rehearsal.
    path
        (horizon,) intended place of the ball at the end of each frame [m].
    """

    def __init__(self, lift: Lift, human: Array, path: Array) -> None:
        self._lift, self._human, self._path = lift, human, path
        self._law = _law(lift.frames_per_step)

    def reset(self, seed: int) -> None:
        """Begin the episode."""
        self._last = 0.0

    def act(self, observation: Observation) -> Action:
        """Return the change of the command [m]."""
        lift, law = self._lift, self._law
        world, count = lift.world, len(law.reply)
        coming = np.minimum(np.arange(lift.frame, lift.frame + count), lift.horizon - 1)
        left = world.human_end[-1] - self._human[max(lift.frame - 1, 0)]
        human = self._human[coming] + left * KEPT ** np.arange(count)
        sag = lift.command - self._last * ARM_LAG / FRAME / lift.frames_per_step
        sag -= world.robot_end[-1]
        level = world.ball_place[-1] + world.ball_speed[-1] * FRAME * np.arange(1, count + 1)
        missing = self._path[coming] - level - law.reply @ (lift.command - sag - human)
        change = float(law.gain @ missing) + law.change * self._last
        self._last = min(max(change, -lift.step_limit), lift.step_limit)
        return np.array([change])


def foresee(lift: Lift, seed: int) -> Episode:
    """Return the episode of a seed, played by the oracle.

    It is rehearsed, starting from an episode of :class:`.BallGame`: each time the oracle expects
    the human's end to move as in the last rehearsal, and brings the ball nearer to its target. It
    sees the true state of the world without delay.
    """
    best = last = run_episode(lift, BallGame(), seed)
    for _ in range(REHEARSALS):
        human, ball = last.trace.human_end, last.trace.added["ball"]
        lost = lift.horizon - len(human)
        human = np.concatenate((human, np.full(lost, human[-1])))
        ball = np.concatenate((ball, lift.due.place[len(ball) :]))
        path = ball + NEARER * (lift.due.place - ball)
        last = run_episode(lift, Foreseeing(lift, human, path), seed)
        if last.scores["rmse_mm"] < best.scores["rmse_mm"]:
            best = last
    return best
