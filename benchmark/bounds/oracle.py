"""The oracle: knows what the human will do, and has the same arm. It is no policy: it cheats."""

from collections.abc import Callable
from concurrent.futures import Executor
from dataclasses import dataclass
from typing import Final

import numpy as np
from numpy.typing import NDArray

from ...agents.agent import FRAME, Action, Observation, RobotObservation
from ...agents.control.anticipation import ARM_LAG
from ...agents.control.preview import preview_gains
from ...agents.loading.loading import source_digest
from ..episode.episode import Episode, run_episode
from ..episode.lift import Lift
from ..episode.scenario import Scenario
from ..execution.kept_world import drop_kept_world, lift_in_kept_world
from ..execution.runner import Run
from ..suites.suite import Suite

ORACLE: Final = "oracle"

REHEARSALS: Final = 5
"""How often an episode is played; the best time counts. It changes little after the third."""

FORESIGHT: Final = 0.6
"""How far ahead commands are planned [s]: farther ones do not change the next."""


class Foreknowing:
    """Commands that best follow a path known for the whole episode.

    Parameters
    ----------
    path
        (n,) height for the command in each frame [m]; its last stays.
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


def foreknow(lift: Lift, seed: int) -> Episode:
    """Return the episode of a seed, played by the oracle.

    It is rehearsed, as in iterative learning control: the first time the oracle follows the
    human's private plan, and each further time its own last command plus the height difference
    that was left, an arm's lag earlier. So it comes to know how this human moves with this robot,
    and how the arm sags. What remains is what a hand cannot do that ramps from period to period.
    """
    lift.reset(seed)
    lag = round(ARM_LAG / FRAME)
    path = np.concatenate((lift.target[lag:], np.full(lag, lift.target[-1])))
    best: Episode | None = None
    for _ in range(REHEARSALS):
        episode = run_episode(lift, Foreknowing(path, lift.frames_per_step), seed)
        if best is None or episode.scores["rmse_mm"] < best.scores["rmse_mm"]:
            best = episode
        trace = episode.trace
        left = trace.human_end - trace.robot_end
        ends = np.concatenate(([0.0], np.cumsum(trace.action[:, 0])))
        frames = np.arange(1, len(left) + 1) / lift.frames_per_step
        command = np.interp(frames, np.arange(len(ends)), ends)
        path = command + np.concatenate((left[lag:], np.full(lag, left[-1])))
    assert best is not None
    return best


@dataclass(frozen=True, kw_only=True)
class Rehearsed:
    """Episodes of one scenario, for a worker process."""

    scenario: Scenario
    seeds: tuple[int, ...]

    def __call__(self) -> list[Episode]:
        """Return the episodes of the oracle."""
        with lift_in_kept_world(self.scenario) as lift:
            return [foreknow(lift, seed) for seed in self.seeds]


def oracle_run(
    suite: Suite,
    *,
    executor: Executor | None = None,
    progress: Callable[[int], None] = lambda episodes: None,
) -> Run:
    """Return the oracle's episodes on a suite; ``executor`` and ``progress`` as of run_suite."""
    tasks = [
        Rehearsed(scenario=scenario, seeds=(seed,))
        for scenario in suite.scenarios
        for seed in suite.seeds
    ]
    episodes: list[Episode] = []
    play = Rehearsed.__call__
    played = map(play, tasks) if executor is None else executor.map(play, tasks, chunksize=5)
    try:
        for some in played:
            episodes += some
            progress(len(some))
    finally:
        drop_kept_world()
    return Run(
        policy=ORACLE,
        policy_digest=source_digest(Foreknowing),
        suite=suite,
        episodes=tuple(episodes),
    )
