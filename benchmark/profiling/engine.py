"""The speed of the benchmark, as ratios of figures measured in one run."""

import statistics
import sys
import time
from collections.abc import Callable, Iterator
from concurrent.futures import Executor
from contextlib import AbstractContextManager
from typing import Final

from colift.agents.loading.policy_spec import PolicySpec
from colift.agents.policies.copy import Copy
from colift.benchmark.episode.lift import Lift
from colift.benchmark.episode.loop import run_episode
from colift.benchmark.execution.runner import run_suite
from colift.benchmark.suites.catalogue import make_scenario
from colift.benchmark.suites.suite import make_suite
from colift.benchmark.world.bullet import pybullet
from colift.benchmark.world.table import GRAVITY
from colift.robots.nao.urdf import nao_urdf_path

if sys.platform != "win32":
    import resource

NAIVE_RATE: Final = 240.0
"""PyBullet's default stepping rate [Hz]."""


def _seconds(action: Callable[[], object], times: int = 1) -> float:
    """Return the mean wall time of an action [s]."""
    begin = time.perf_counter()
    for _ in range(times):
        action()
    return (time.perf_counter() - begin) / times


def naive_speed(steps: int = 400) -> float:
    """Return simulated seconds per wall second of the whole NAO, with all joints, at 240 Hz."""
    client = pybullet.connect(pybullet.DIRECT)
    try:
        pybullet.setGravity(0, 0, -GRAVITY, physicsClientId=client)
        pybullet.setTimeStep(1 / NAIVE_RATE, physicsClientId=client)
        pybullet.loadURDF(str(nao_urdf_path()), useFixedBase=True, physicsClientId=client)
        return 1 / NAIVE_RATE / _seconds(lambda: pybullet.stepSimulation(client), steps)
    finally:
        pybullet.disconnect(client)


def single_process(episodes: int = 20, rounds: int = 5) -> dict[str, float]:
    """Measure whole episodes, plan and scores included, in this process.

    Returns
    -------
    dict
        ``sim_speed``: simulated seconds per wall second; ``reset_share``: share of the time for
        resetting an episode; ``naive_nao_ratio``: the speed relative to :func:`naive_speed`.
        Medians over the rounds.
    """
    lift = Lift(make_scenario("smooth", "S1"))

    def play() -> int:
        return sum(len(run_episode(lift, Copy(), seed).trace.human_end) for seed in range(episodes))

    play()
    samples: dict[str, list[float]] = {
        name: [] for name in ("sim_speed", "naive_nao_ratio", "reset_share")
    }
    for _ in range(rounds):
        naive = naive_speed()
        begin = time.perf_counter()
        frames = play()
        wall = time.perf_counter() - begin
        resets = sum(_seconds(lambda s=seed: lift.reset(s)) for seed in range(episodes))  # type: ignore[misc]
        samples["sim_speed"].append(frames / 100 / wall)
        samples["reset_share"].append(resets / wall)
        samples["naive_nao_ratio"].append(frames / 100 / wall / naive)
    lift.close()
    return {name: statistics.median(values) for name, values in samples.items()}


def two_workers_ratio(
    pool: Callable[[int], AbstractContextManager[Executor]], rounds: int = 3
) -> dict[str, float]:
    """Measure the throughput of two worker processes relative to one, on ``standard-v1``.

    Parameters
    ----------
    pool
        Returns a context manager that yields an executor with the given number of processes.
    rounds
        Pairs of runs; the median ratio counts.
    """
    policy = PolicySpec(text="copy")
    suite = make_suite("standard-v1").with_seeds(0, 5)
    warm_up = make_suite("quick-v1")
    ratios = []
    with pool(1) as one, pool(2) as two:
        for executor in (one, two):
            run_suite(policy, warm_up, executor=executor)
        for _ in range(rounds):
            alone = _seconds(lambda: run_suite(policy, suite, executor=one))
            ratios.append(alone / _seconds(lambda: run_suite(policy, suite, executor=two)))
    return {"two_workers_ratio": statistics.median(ratios)}


def endurance(episodes: int) -> Iterator[dict[str, float]]:
    """Play episodes in one world and yield the figures after each hundred.

    Yields
    ------
    dict
        ``episodes`` so far; ``memory_mb`` the largest resident size of the process so far;
        ``ms_per_episode`` the mean wall time over the last hundred.
    """
    lift = Lift(make_scenario("smooth", "S1"))
    hundred = 100
    for done in range(hundred, episodes + 1, hundred):
        seconds = _seconds(lambda: run_episode(lift, Copy(), done % hundred), hundred)  # noqa: B023
        peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024
        yield {"episodes": done, "memory_mb": peak, "ms_per_episode": 1000 * seconds}
    lift.close()
