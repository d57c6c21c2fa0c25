"""Throughput of a Dask cluster and of verification, relative to the local pool."""

import statistics
import tempfile
import time
from collections.abc import Callable
from pathlib import Path
from typing import Final, ParamSpec, TypeVar

from colift.agents.loading.policy_spec import PolicySpec
from colift.benchmark.bundle import results, write_bundle
from colift.benchmark.execution.connecting import dask_pool
from colift.benchmark.execution.pool import process_pool
from colift.benchmark.execution.runner import run_suite
from colift.benchmark.profiling.loopback import loopback_cluster
from colift.benchmark.results.baselines import shipped_baselines
from colift.benchmark.suites.suite import make_suite
from colift.benchmark.verification import verify

P = ParamSpec("P")
T = TypeVar("T")

WORKERS: Final = 2


def scale(
    policy: str = "blend",
    suite: str = "standard-v1",
    rounds: int = 5,
    progress: Callable[[int], None] = lambda episodes: None,
) -> dict[str, float]:
    """Measure throughputs relative to a run in the local pool, all with two worker processes.

    The measurements take turns, and the median of the rounds counts.

    Parameters
    ----------
    policy
        Name of the policy: the less time it takes, the clearer the overhead.
    suite
        The suite, which must have shipped baselines.
    rounds
        Number of rounds, with each of the three once.
    progress
        Called with the number of episodes that were finished since the last call; in all, three
        times the suite's episodes per round.

    Returns
    -------
    dict
        ``dask_ratio`` of a run on a Dask cluster of this machine, whose scheduler is a process of
        its own; ``verify_ratio`` of verifying a bundle over making it.
    """
    spec, episodes = PolicySpec(text=policy), make_suite(suite)
    baselines = shipped_baselines(episodes) or {}
    ratios: dict[str, list[float]] = {"dask_ratio": [], "verify_ratio": []}
    with (
        tempfile.TemporaryDirectory(prefix="colift-") as folder,
        process_pool(WORKERS) as local,
        loopback_cluster(WORKERS) as address,
        dask_pool(address) as cluster,
    ):
        bundle = Path(folder, "bundle")
        for executor in (local, cluster):
            run_suite(spec, make_suite("quick-v1"), executor=executor)
        for _ in range(rounds):
            alone, run = _timed(run_suite, spec, episodes, executor=local, progress=progress)
            far, _ = _timed(run_suite, spec, episodes, executor=cluster, progress=progress)
            write, _ = _timed(write_bundle, bundle, run, results(run, baselines).plain())
            again, _ = _timed(verify, bundle, executor=local, progress=progress)
            ratios["dask_ratio"].append(alone / far)
            ratios["verify_ratio"].append((alone + write) / again)
    return {name: statistics.median(values) for name, values in ratios.items()}


def _timed(call: Callable[P, T], /, *args: P.args, **kwargs: P.kwargs) -> tuple[float, T]:
    """Return the wall time of a call [s], and its result."""
    begin = time.perf_counter()
    result = call(*args, **kwargs)
    return time.perf_counter() - begin, result
