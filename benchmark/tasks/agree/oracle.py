"""The oracle of two hurdles: it knows both secrets and the human's coming motion. It cheats."""

from typing import Final, NamedTuple

import numpy as np
from colift.agents.agent import FRAME, Action, Observation, RobotObservation
from colift.agents.humans.stroke import replan
from colift.benchmark.episode.lift import Lift
from colift.benchmark.episode.loop import Episode, run_episode
from colift.benchmark.tasks.agree.task import hurdles_of
from colift.benchmark.tasks.rehearsal import Foreknowing, raised
from numpy.typing import NDArray

STARTS: Final = 5
"""Number of starting times, over its window, that are tried for a detour to the robot's hurdle."""

DURATIONS: Final = (0.45, 0.8)
"""Durations of the way there [s]."""

STAYS: Final = (0.15, 0.4)
"""Durations of the stay there [s]."""

REHEARSALS: Final = 3
"""Number of further rehearsals of each of the best detours, to be more level."""

KEPT: Final = 2
"""Number of the best detours that are rehearsed."""

LEAD: Final = 0.1
"""Time by which the present motion is extrapolated while it is new [s]."""

RETURN: Final = 0.2
"""Time in which the command returns from a detour to the human's height [s]."""


class Detour(NamedTuple):
    """A way to the robot's hurdle."""

    start: int
    """Its first frame."""
    way: int
    """Frames on the way."""
    stay: int
    """Frames at the hurdle."""


class Knowing:
    """Keeps level by the true present motion, except for a detour to the robot's hurdle.

    Parameters
    ----------
    lift
        The lift that it plays, whose world it reads.
    detour
        The detour to the hurdle, or None for no detour.
    """

    def __init__(self, lift: Lift, detour: Detour | None) -> None:
        self._lift, self._detour = lift, detour

    def reset(self, seed: int) -> None:
        """Begin the episode."""
        self._path: NDArray[np.float64] | None = None
        self._sag = self._change = 0.0

    def act(self, observation: Observation) -> Action:
        """Return the change of the command [m]."""
        lift, detour = self._lift, self._detour
        world, frame, frames = lift.world, lift.frame, lift.frames_per_step
        command = float(observation[RobotObservation.HAND_COMMAND])
        if abs(self._change) < 0.003:
            self._sag += 0.5 * (command - world.robot_end[-1] - self._sag)
        meant = world.human_end[-1] + LEAD * world.human_velocity[-1] + self._sag
        _, hurdle = hurdles_of(lift.plan)
        if detour is not None and hurdle is not None:
            after = frame + frames - detour.start
            if after > 0:
                if self._path is None:
                    state = (command, self._change / (frames * FRAME), 0.0)
                    self._path = replan(state, hurdle.height + self._sag, detour.way * FRAME)[0]
                end = detour.way + detour.stay
                share = min(max((after - end) / (RETURN / FRAME), 0.0), 1.0)
                there = float(self._path[min(after, len(self._path)) - 1])
                meant = share * meant + (1 - share) * there
        self._change = meant - command
        return np.array([self._change])


def foreknow_agreement(lift: Lift, seed: int) -> Episode:
    """Return the episode of a seed, played by the oracle.

    It tries detours to its own hurdle at all times of the window, using the true present motion of
    the human, and rehearses the best ones as :func:`.rehearse_lift` does: outside the detour each
    command is that of the last rehearsal plus the remaining height difference, an arm's lag
    earlier.
    """
    lift.reset(seed)
    tried = sorted(
        ((run_episode(lift, Knowing(lift, detour), seed), detour) for detour in detours(lift)),
        key=lambda each: each[0].scores["rmse_mm"],
    )
    best = tried[0][0]
    for episode, detour in tried[:KEPT]:
        for _ in range(REHEARSALS):
            path = _more_level(lift, episode, detour)
            episode = run_episode(lift, Foreknowing(path, lift.frames_per_step), seed)
            best = min(best, episode, key=lambda each: each.scores["rmse_mm"])
    return best


def detours(lift: Lift) -> list[Detour | None]:
    """Return the detours to try in the lift's current episode."""
    _, hurdle = hurdles_of(lift.plan)
    if hurdle is None:
        return [None]
    starts = np.linspace(hurdle.start - 35, hurdle.stop - 40, STARTS).round().astype(int).tolist()
    return [
        Detour(start, round(way / FRAME), round(stay / FRAME))
        for start in starts
        for way in DURATIONS
        for stay in STAYS
    ]


def _more_level(lift: Lift, episode: Episode, detour: Detour | None) -> NDArray[np.float64]:
    """Return the path to command next: more level, except in the detour."""
    left = episode.trace.human_end - episode.trace.robot_end
    if detour is not None:
        left[detour.start : detour.start + detour.way + detour.stay] = 0.0
    return raised(lift, episode.trace, left)
