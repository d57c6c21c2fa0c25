"""The oracle of the ball: it knows the plan, the target, and what the human will do."""

from functools import cache
from typing import Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from ....agents.agent import FRAME, Action, Observation
from ....agents.control.anticipation import ARM_LAG
from ....agents.policies.ball_game import BallGame
from ...episode.episode import Episode, run_episode
from ...episode.lift import Lift
from ...world.ball import ROLLING
from ...world.table import GRAVITY, TABLE_LENGTH
from .lift import BallLift

REHEARSALS: Final = 10
"""How often an episode is rehearsed; the best time counts."""

NEARER: Final = 0.6
"""Part of the way from the ball's path of the last rehearsal to the target that the next one goes:
a person who steers much answers a large change by a larger one."""

STEPS: Final = 15
"""Periods ahead over which commands are planned."""

BENDS: Final = 3.0
"""Cost of a bend of the command, relative to a distance of the ball of its size that lasts for a
frame. A person who steers much makes plans of little cost unstable."""

KEPT: Final = 0.97
"""Part of the human's deviation from the last rehearsal that is expected to last for a frame."""

Array = NDArray[np.float64]


class Law(NamedTuple):
    """The matrices of :func:`_law`."""

    reply: Array
    """(n, n) place of the ball in each coming frame by the height difference in each [1]."""
    gain: Array
    """(n,) next command by the place that is missing in each frame."""
    change: float
    """Next command by the last change of the command."""


@cache
def _law(frames: int) -> Law:
    """Return the matrices of the plan for periods of so many frames.

    The ball's place in the coming n frames is what it would be on a level table, plus ``reply`` d
    with the height difference d = u - z1. The coming commands' changes from the present one
    minimise the squared distance from the path and :data:`BENDS` times their squared bends.
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
    """Commands that best bring the ball along a path, with all that is and will be known.

    Parameters
    ----------
    lift
        The lift being played, whose true state is read.
    human
        (horizon,) height of the human's end in each frame [m], as it was in the last rehearsal.
    path
        (horizon,) where the ball should be at the end of each frame [m].
    """

    def __init__(self, lift: BallLift, human: Array, path: Array) -> None:
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

    It is rehearsed, from an episode of :class:`.BallGame` on: each time the oracle expects the
    human's end to move as the last time, and means to bring the ball nearer to its target. It sees
    the true state of the world without delay.
    """
    assert isinstance(lift, BallLift)
    best = last = run_episode(lift, BallGame(), seed)
    for _ in range(REHEARSALS):
        human, ball = last.trace.human_end, last.trace.added["ball"]
        lost = lift.horizon - len(human)
        human = np.concatenate((human, np.full(lost, human[-1])))
        ball = np.concatenate((ball, lift.place[len(ball) :]))
        path = ball + NEARER * (lift.place - ball)
        last = run_episode(lift, Foreseeing(lift, human, path), seed)
        if last.scores["rmse_mm"] < best.scores["rmse_mm"]:
            best = last
    return best
