"""The oracle: it knows the human's plan, with the same arm. It is not a policy: it cheats."""

from collections.abc import Callable, Mapping
from concurrent.futures import Executor
from dataclasses import dataclass
from typing import Final

from colift.base.errors import InputError
from colift.base.identity import code_hash
from colift.benchmark.episode.kept_world import drop_kept_world, lift_in_kept_world
from colift.benchmark.episode.lift import Lift
from colift.benchmark.episode.loop import Episode, run_episode
from colift.benchmark.episode.scenario import Scenario
from colift.benchmark.execution.runner import Run
from colift.benchmark.references.best_known import BestKnown
from colift.benchmark.suites.suite import Suite
from colift.benchmark.tasks.agree.oracle import foreknow_agreement
from colift.benchmark.tasks.agree.task import Agree
from colift.benchmark.tasks.ball.oracle import foresee
from colift.benchmark.tasks.ball.task import BallSteering
from colift.benchmark.tasks.intent.oracle import foreknow_pose
from colift.benchmark.tasks.intent.task import Intent
from colift.benchmark.tasks.level.task import Level
from colift.benchmark.tasks.rehearsal import refine, rehearse_lift

ORACLE: Final = "oracle"


def foreknow(lift: Lift, seed: int) -> Episode:
    """Return the episode of a seed with a level table, played by the oracle.

    It knows the human's private plan, and after each rehearsal how the human moved; see
    :func:`.rehearse_lift`.
    """
    return rehearse_lift(
        lift, seed, lambda lift: lift.target, lambda trace: trace.human_end - trace.robot_end
    )


def foreknow_hurdles(lift: Lift, seed: int) -> Episode:
    """Return the episode of a seed with hurdles, played by the oracle.

    It tries its own ways (:func:`.foreknow_agreement`) and those of a policy that knows no private
    hurdle, and rehearses the better of them further (:func:`.refine`).
    """
    trained = run_episode(lift, BestKnown(task=Agree.name).make(), seed)
    known = foreknow_agreement(lift, seed)
    return refine(lift, seed, min(known, trained, key=lambda each: each.scores["rmse_mm"]))


ORACLES: Final[Mapping[str, Callable[[Lift, int], Episode]]] = {
    Level.name: foreknow,
    Agree.name: foreknow_hurdles,
    Intent.name: foreknow_pose,
    BallSteering.name: foresee,
}
"""Oracles by task: each returns the episode of a lift with a seed."""


@dataclass(frozen=True, kw_only=True)
class Rehearsed:
    """Episodes of one scenario, for a worker process."""

    scenario: Scenario
    seeds: tuple[int, ...]

    def __call__(self) -> list[Episode]:
        """Return the episodes of the oracle."""
        play = ORACLES[self.scenario.task.name]
        with lift_in_kept_world(self.scenario) as lift:
            return [play(lift, seed) for seed in self.seeds]


def oracle_run(
    suite: Suite,
    *,
    executor: Executor | None = None,
    progress: Callable[[int], None] = lambda episodes: None,
) -> Run:
    """Return the oracle's episodes on a suite; ``executor`` and ``progress`` as for run_suite.

    Raises
    ------
    InputError
        If the suite's task has no oracle.
    """
    task = suite.scenarios[0].task.name
    if task not in ORACLES:
        raise InputError(f"the task {task!r} has no oracle; known: {', '.join(ORACLES)}")
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
        policy_digest=code_hash(ORACLES[task]),
        suite=suite,
        episodes=tuple(episodes),
    )
