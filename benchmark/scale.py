"""What many processes cost and bring: a Dask cluster, and verification, against the local pool."""

import statistics
import tempfile
import time
from collections.abc import Callable
from pathlib import Path
from typing import Final

from ..agents.policies.loading import PolicySpec
from .bundle import results, write_bundle
from .connecting import dask_pool
from .executors import process_pool
from .loopback import loopback_cluster
from .references import shipped_references
from .runner import run_suite
from .shipping import shipped
from .suite import make_suite
from .verification import verify

WORKERS: Final = 2


def scale(
    suite: str = "standard-v1",
    rounds: int = 5,
    progress: Callable[[int], None] = lambda episodes: None,
) -> dict[str, float]:
    """Measure throughputs over that of a run in the local pool, all with two worker processes.

    They take turns, and the median of the rounds counts. The policy is ``copy``, which takes next
    to no time of its own.

    Parameters
    ----------
    suite
        What is run: a suite with shipped references.
    rounds
        How often each is run.
    progress
        Called with the number of episodes that were finished since the last call; in all they are
        three times the suite's a round.

    Returns
    -------
    dict
        ``dask_ratio`` of a run on a Dask cluster of this machine, whose scheduler is a process of
        its own; ``verify_ratio`` of the verification of the run's bundle.
    """
    policy, episodes = PolicySpec(text="copy"), make_suite(suite)
    sent = shipped(policy)
    ratios: dict[str, list[float]] = {"dask_ratio": [], "verify_ratio": []}
    with (
        tempfile.TemporaryDirectory(prefix="colift-") as folder,
        process_pool(WORKERS) as local,
        loopback_cluster(WORKERS) as address,
        dask_pool(address) as cluster,
    ):
        bundle = Path(folder, "bundle")
        run = run_suite(policy, episodes, executor=local)
        write_bundle(bundle, run, results(run, shipped_references(episodes) or {}))
        run_suite(sent, make_suite("quick-v1"), executor=cluster)
        for _ in range(rounds):
            alone = _seconds(lambda: run_suite(policy, episodes, executor=local, progress=progress))
            far = _seconds(lambda: run_suite(sent, episodes, executor=cluster, progress=progress))
            again = _seconds(lambda: verify(bundle, executor=local, progress=progress))
            ratios["dask_ratio"].append(alone / far)
            ratios["verify_ratio"].append(alone / again)
    return {name: statistics.median(values) for name, values in ratios.items()}


def _seconds(action: Callable[[], object]) -> float:
    """Return the wall time of an action [s]."""
    begin = time.perf_counter()
    action()
    return time.perf_counter() - begin
