"""``colift run``: evaluate a policy on a suite."""

from collections.abc import Mapping
from concurrent.futures import Executor
from contextlib import AbstractContextManager, nullcontext
from functools import partial
from pathlib import Path
from typing import Annotated, Final

import typer

from ..agents.errors import EvaluatorFault, InputError
from ..benchmark.agent_spec import AgentSpec
from ..benchmark.bundle import check_target, results, write_bundle
from ..benchmark.cluster import Cluster
from ..benchmark.journal import Journal, open_journal
from ..benchmark.origin import origin, platform
from ..benchmark.references import SPECS, Reference, play_references, shipped_references
from ..benchmark.runner import Run, run_suite
from ..benchmark.shipping import shipped
from ..benchmark.suite import Suite
from .executors import Jobs, executor
from .policies import AUTO, HELP, choose_policy
from .progress import progress_bar
from .run_report import complain, mention_idle, print_results
from .suites import chosen_suite

GO_ON: Final = "what is finished is kept: go on by the same command with --resume"


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
    jobs: Jobs = None,
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
    with executor(jobs, dask) as workers:
        there = origin()
        if isinstance(workers, Cluster):
            spec, there = shipped(spec), workers.origin
            mention_idle(workers)
        with _journal(out, resume, _identity(spec, episodes, there)) as journal:
            done, references = _evaluate(spec, episodes, workers, journal)
            finished = done.complete and references.keys() == SPECS.keys()
            content = results(done, references) if done.episodes else None
            if content is not None and out is not None:
                write_bundle(out, done, content, platform=platform(there))
            if journal is not None and finished:
                journal.remove()
    if content is not None:
        print_results(content, out, as_json=as_json)
    if complain(done, finished=finished, hint="" if out is None else GO_ON):
        raise typer.Exit(1)


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
) -> tuple[Run, Mapping[str, Reference]]:
    """Run the policy, then the references on the same episodes, unless they are shipped."""
    ready = shipped_references(suite)
    total = suite.size * (1 if ready else 1 + len(SPECS))
    with progress_bar(spec.name, total) as progress:
        play = partial(run_suite, spec, suite, executor=workers, progress=progress)
        try:
            done = play() if journal is None else play(done=journal.done, keep=journal.keep)
            if not done.complete:
                return done, {}
            if ready is None:
                ready = play_references(suite, executor=workers, progress=progress)
        except EvaluatorFault as fault:
            if journal is None:
                raise
            raise EvaluatorFault(f"{fault}; {GO_ON}") from fault
    return done, ready
