"""``colift run``: evaluate a policy on a suite."""

import json
import sys
from collections.abc import Mapping
from concurrent.futures import Executor
from contextlib import AbstractContextManager, nullcontext
from functools import partial
from pathlib import Path
from typing import Annotated, Final

import typer
from rich.console import Console

from ..agents.errors import EvaluatorFault, InputError
from ..benchmark.agent_spec import AgentSpec
from ..benchmark.bundle import check_target, results, write_bundle
from ..benchmark.cluster import Cluster, dask_pool
from ..benchmark.executors import default_jobs, local_pool
from ..benchmark.journal import Journal, open_journal
from ..benchmark.origin import origin, platform
from ..benchmark.references import SPECS, Reference, play_references, shipped_references
from ..benchmark.runner import Run, run_suite
from ..benchmark.shipping import shipped
from ..benchmark.suite import Suite
from .policies import AUTO, HELP, choose_policy
from .progress import progress_bar
from .suites import chosen_suite
from .tables import results_table, standing

_RESUME: Final = "; what is finished is kept: go on by the same command with --resume"


def run(
    policy: Annotated[str, typer.Argument(help=HELP)],
    suite: Annotated[str, typer.Option(help="Scenario suite.")] = "standard-v1",
    seeds: Annotated[
        str | None, typer.Option(metavar="A:B", help="Seeds A to B-1 instead of the suite's.")
    ] = None,
    recordings: Annotated[
        Path | None,
        typer.Option(metavar="CSV", help="Recorded lifts (trial,t_s,z_m) instead of a suite."),
    ] = None,
    latency: Annotated[
        float | None,
        typer.Option(metavar="S", help="Age of the robot's data, in seconds."),
    ] = None,
    control_period: Annotated[
        float | None, typer.Option(metavar="S", help="Time between two decisions, in seconds.")
    ] = None,
    isolation: Annotated[
        str,
        typer.Option(
            help="What keeps the policy apart: auto (a sandbox, unless it is colift's own), none, "
            "bubblewrap, landlock or limits."
        ),
    ] = AUTO,
    jobs: Annotated[
        int | None, typer.Option(metavar="N", help="Worker processes; default: all cores.")
    ] = None,
    dask: Annotated[
        str | None,
        typer.Option(metavar="URL", help="Use the Dask cluster of this scheduler: tcp://host:8786"),
    ] = None,
    out: Annotated[
        Path | None, typer.Option(metavar="DIR", help="Where to write the result bundle.")
    ] = None,
    resume: Annotated[
        bool,
        typer.Option("--resume", help="Go on with the run of the same --out that was interrupted."),
    ] = False,
    as_json: Annotated[
        bool, typer.Option("--json", help="Print results.json alone, and nothing else.")
    ] = False,
) -> None:
    """Evaluate a policy on a scenario suite and print where it stands.

    With --out, every lift is kept as soon as it is finished: what is interrupted can be resumed.
    """
    episodes = chosen_suite(suite, seeds, recordings).with_timing(latency, control_period)
    if resume and out is None:
        raise InputError("--resume needs the --out of the run that was interrupted")
    if out is not None:
        check_target(out)
    spec = choose_policy(policy, isolation)
    spec.check()
    with _workers(jobs, dask) as workers:
        there = origin()
        if isinstance(workers, Cluster):
            spec, there = shipped(spec), workers.origin
        with _journal(out, resume, _identity(spec, episodes, there)) as journal:
            done, references = _evaluate(spec, episodes, workers, journal)
            if not done.episodes:
                print("interrupted before the first episode was finished", file=sys.stderr)
                raise typer.Exit(1)
            content = results(done, references)
            if out is not None:
                write_bundle(out, done, content, platform=platform(there))
            if journal is not None and done.complete:
                journal.remove()
    if as_json:
        print(json.dumps(content, indent=2, allow_nan=False))
    else:
        console = Console()
        console.print(results_table(content))
        console.print(standing(content), highlight=False)
        if out is not None:
            console.print(f"Result bundle: {out}", highlight=False, soft_wrap=True)
    if _complaints(done, resumable=out is not None):
        raise typer.Exit(1)


def _workers(jobs: int | None, dask: str | None) -> AbstractContextManager[Executor | None]:
    """Return what plays the episodes; None is this process."""
    if dask is None:
        return local_pool(default_jobs() if jobs is None else jobs)
    if jobs is not None:
        raise InputError("--jobs and --dask exclude each other: a cluster has its own workers")
    return dask_pool(dask)


def _identity(spec: AgentSpec, suite: Suite, there: Mapping[str, str]) -> dict[str, str]:
    """Return whatever an episode depends on, by name."""
    return {
        "policy": spec.name,
        "policy digest": spec.digest(),
        "suite": suite.name,
        "suite digest": suite.digest,
        "isolation": spec.isolation,
        **there,
    }


def _journal(
    out: Path | None, resume: bool, identity: Mapping[str, str]
) -> AbstractContextManager[Journal | None]:
    """Return where finished episodes are kept, if there is to be a bundle."""
    return nullcontext() if out is None else open_journal(out, identity, resume=resume)


def _evaluate(
    spec: AgentSpec, suite: Suite, workers: Executor | None, journal: Journal | None
) -> tuple[Run, dict[str, Reference]]:
    """Run the policy, then the references on the same episodes, unless they are shipped."""
    ready = shipped_references(suite)
    total = suite.size * (1 if ready else 1 + len(SPECS))
    with progress_bar(spec.name, total) as progress:
        play = partial(run_suite, spec, suite, executor=workers, progress=progress)
        try:
            done = play() if journal is None else play(done=journal.done, keep=journal.keep)
        except EvaluatorFault as fault:
            raise EvaluatorFault(f"{fault}{'' if journal is None else _RESUME}") from fault
        if ready is None and done.complete:
            return done, play_references(suite, executor=workers, progress=progress)
    return done, ready if ready and done.complete else {}


def _complaints(run: Run, *, resumable: bool) -> bool:
    """Say on stderr what went wrong; return whether the result is to be doubted."""
    failures = [episode for episode in run.episodes if episode.failure is not None]
    if run.faults:
        print(f"{_counted(run.faults)} because a worker died or a machine failed", file=sys.stderr)
    if failures:
        first = failures[0]
        print(
            f"{len(failures)} of {len(run.episodes)} episodes failed and count as worst; "
            f"the first, {first.behaviour}/{first.subject} seed {first.seed}: {first.failure}",
            file=sys.stderr,
        )
    if not run.complete:
        print(
            f"interrupted: partial results of {len(run.episodes)} of {run.suite.size} episodes"
            f"{_RESUME if resumable else ''}",
            file=sys.stderr,
        )
    return bool(failures) or not run.complete


def _counted(faults: int) -> str:
    return "1 task was played again" if faults == 1 else f"{faults} tasks were played again"
