"""What ``colift run`` says at its end."""

import json
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from rich.console import Console

from ..benchmark.cluster import Cluster
from ..benchmark.runner import Run
from .arguments import argument
from .tables import results_table, standing


def print_results(content: dict[str, Any], out: Path | None, *, as_json: bool) -> None:
    """Print the results, as tables and where the policy stands, or as JSON alone."""
    if as_json:
        print(json.dumps(content, indent=2, allow_nan=False))
        return
    console = Console()
    console.print(results_table(content))
    console.print(standing(content), highlight=False)
    if out is not None:
        print(f"Result bundle: {out}")
        if content["complete"]:
            print(f"Next: colift verify {argument(out)}")


def mention_idle(cluster: Cluster) -> None:
    """Say on stderr if a cluster's workers have threads that will get nothing to do."""
    if cluster.idle_threads:
        print(
            f"{cluster.idle_threads} threads of the workers stay idle, since each worker plays one "
            "lift at a time: start them by dask worker ... --nworkers auto --nthreads 1",
            file=sys.stderr,
        )


def complain(run: Run, *, finished: bool, hint: str) -> bool:
    """Say on stderr what went wrong; return whether the result is to be doubted.

    Parameters
    ----------
    run
        What was played.
    finished
        Whether that is everything, the references included.
    hint
        How to go on with what is not finished.
    """
    for line in (*_faults(run), *_failures(run)):
        print(line, file=sys.stderr)
    if not finished:
        print("; ".join(part for part in (_interrupted(run), hint) if part), file=sys.stderr)
    return not finished or any(episode.failure is not None for episode in run.episodes)


def _faults(run: Run) -> Iterator[str]:
    if run.faults:
        again = "1 task was" if run.faults == 1 else f"{run.faults} tasks were"
        yield f"{again} played again because a worker died or a machine failed"


def _failures(run: Run) -> Iterator[str]:
    failed = [episode for episode in run.episodes if episode.failure is not None]
    if failed:
        first = failed[0]
        yield (
            f"{len(failed)} of {len(run.episodes)} episodes failed and count as worst; "
            f"the first, {first.behaviour}/{first.subject} seed {first.seed}: {first.failure}"
        )


def _interrupted(run: Run) -> str:
    if not run.episodes:
        return "interrupted before the first episode was finished"
    if not run.complete:
        return f"interrupted: partial results of {len(run.episodes)} of {run.suite.size} episodes"
    return "interrupted before the references were played: there is nothing to compare with"
