"""Rehearsed lifts: a robot that knows its end's intended path, and learns the commands for it."""

from collections.abc import Callable
from typing import Final

import numpy as np
from colift.agents.agent import FRAME, Action, Observation, RobotObservation
from colift.agents.control.anticipation import ARM_LAG
from colift.agents.control.preview import preview_gains
from colift.benchmark.episode.lift import Lift
from colift.benchmark.episode.loop import Episode, run_episode
from colift.benchmark.episode.trace import Trace
from numpy.typing import NDArray

REHEARSALS: Final = 5
"""Number of rehearsals of an episode; the best one counts. It changes little after the third."""

BUMPS: Final = (0.012, 0.005)
"""Heights of the bumps that :func:`refine` tries [m]."""

BUMP: Final = 35
"""Half of a bump's length, in frames."""

BUMP_SPACING: Final = 25
"""Frames between two bumps."""

FORESIGHT: Final = 0.6
"""Horizon over which commands are planned [s]: a longer one does not change the next command."""


class Foreknowing:
    """Commands that best follow a path known for the whole episode.

    Parameters
    ----------
    path
        (n,) height for the command in each frame [m]; after the path, its last height remains.
    frames
        Frames in a control period.
    """

    def __init__(self, path: NDArray[np.float64], frames: int) -> None:
        self._frames = frames
        steps = max(round(FORESIGHT / FRAME / frames), 1)
        self._law = preview_gains(frames, steps, 0.0)
        self._path = np.concatenate((path, np.full(steps * frames, path[-1])))

    def reset(self, seed: int) -> None:
        """Begin the episode."""
        self._frame = 0

    def act(self, observation: Observation) -> Action:
        """Return the change of the command [m]."""
        coming = self._path[self._frame : self._frame + len(self._law.path)]
        self._frame += self._frames
        command = float(observation[RobotObservation.HAND_COMMAND])
        return np.array([self._law(coming, command, command) - command])


def rehearse_lift(
    lift: Lift,
    seed: int,
    first: Callable[[Lift], NDArray[np.float64]],
    missed: Callable[[Trace], NDArray[np.float64]],
) -> Episode:
    """Return the best of some rehearsals of an episode, as in iterative learning control.

    In the first rehearsal the robot follows a path, in each further one its own last commands plus
    the error of its end then, an arm's lag earlier. It thereby learns how this human moves with
    this robot, and how the arm sags. The error that remains is due to the hand's ramps from period
    to period.

    Parameters
    ----------
    lift
        The lift; it is reset here.
    seed
        The episode's seed.
    first
        Returns the first path of the robot's end [m], (horizon,), for a lift that has been reset.
    missed
        Returns the distance by which the robot's end was too low in each frame of a trace [m].
    """
    lift.reset(seed)
    lag = round(ARM_LAG / FRAME)
    path = _earlier(first(lift), lag)
    best: Episode | None = None
    for _ in range(REHEARSALS):
        episode = run_episode(lift, Foreknowing(path, lift.frames_per_step), seed)
        if best is None or episode.scores["rmse_mm"] < best.scores["rmse_mm"]:
            best = episode
        path = raised(lift, episode.trace, missed(episode.trace))
    assert best is not None
    return best


def refine(lift: Lift, seed: int, episode: Episode) -> Episode:
    """Return the best of many rehearsals, each with another bump in the best commands so far.

    This is a coordinate descent over the heights of bumps along the lift, up and down, from large
    to small.

    Parameters
    ----------
    lift
        The lift; it is reset here.
    seed
        The episode's seed.
    episode
        The episode to begin with.
    """
    frames = lift.frames_per_step
    best, path = episode, frame_commands(lift, episode.trace)
    times = np.arange(len(path))
    for size in BUMPS:
        for centre in range(0, len(path), BUMP_SPACING):
            away = np.abs(times - centre)
            bump = size * np.where(away < BUMP, 0.5 + 0.5 * np.cos(np.pi * away / BUMP), 0.0)
            for bent in (path + bump, path - bump):
                tried = run_episode(lift, Foreknowing(bent, frames), seed)
                if tried.scores["rmse_mm"] < best.scores["rmse_mm"]:
                    best, path = tried, bent
                    break
    return best


def frame_commands(lift: Lift, trace: Trace) -> NDArray[np.float64]:
    """Return the hand's command in each frame of a lift's trace [m], as it was carried out."""
    frames = lift.frames_per_step
    ends = np.concatenate(([0.0], lift.seat.hand_commands(trace.action, frames * FRAME)))
    steps = np.arange(1, len(trace.human_end) + 1) / frames
    return np.asarray(np.interp(steps, np.arange(len(ends)), ends))


def raised(lift: Lift, trace: Trace, missed: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return the commands of a trace, raised by the error an arm's lag later [m].

    Parameters
    ----------
    lift, trace
        The lift, and the trace of a rehearsal.
    missed
        Distance by which the robot's end was too low in each frame [m].
    """
    return frame_commands(lift, trace) + _earlier(missed, round(ARM_LAG / FRAME))


def _earlier(series: NDArray[np.float64], frames: int) -> NDArray[np.float64]:
    return np.concatenate((series[frames:], np.full(frames, series[-1])))
