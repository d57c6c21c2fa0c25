"""``colift run``: the evaluation of a policy on a suite."""

import json
import sys
from collections.abc import Iterator, Mapping
from concurrent.futures import Executor
from contextlib import AbstractContextManager, nullcontext
from functools import partial
from pathlib import Path
from typing import Annotated, Final

import typer

from ..agents.errors import EvaluatorFault, InputError
from ..agents.registry import check_plays
from ..agents.spec import AgentSpec
from ..benchmark.bundle import Results, check_bundle_folder, check_unfinished, results, write_bundle
from ..benchmark.bundle.recipe import FROM_NAMES, Recipe
from ..benchmark.channels import Channel, recorded
from ..benchmark.execution.cluster import Cluster
from ..benchmark.execution.fitting import check_fits
from ..benchmark.execution.journal import Journal, journal_path, open_journal
from ..benchmark.execution.provenance import origin, platform_of
from ..benchmark.execution.runner import InterruptedRunError, Run, run_suite
from ..benchmark.results.baselines import BASELINES, Baseline, play_baselines, shipped_baselines
from ..benchmark.suites.suite import Suite
from .failures import reported_failures
from .options import (
    LATENCY_OPTION,
    PERIOD_OPTION,
    AsJson,
    Behaviours,
    ChannelName,
    Dask,
    Jobs,
    PolicyIsolation,
    PolicyName,
    Recordings,
    Seeds,
    SuiteName,
    chosen_channel,
    chosen_suite,
    executor,
)
from .policies import AUTO, choose_policy
from .printing import argument, counted, print_json, show
from .progress import progress_bar
from .remedies import naming, opened
from .tables.recordings import recordings_json, show_recordings
from .tables.results import results_table, results_text

GO_ON: Final = "the finished lifts are kept: resume with the same command and --resume"


def run(
    policy: PolicyName,
    suite: SuiteName = None,
    behaviour: Behaviours = None,
    seeds: Seeds = None,
    recordings: Recordings = None,
    latency: Annotated[float | None, LATENCY_OPTION] = None,
    control_period: Annotated[float | None, PERIOD_OPTION] = None,
    channel: ChannelName = None,
    isolation: PolicyIsolation = AUTO,
    jobs: Jobs = None,
    dask: Dask = None,
    out: Annotated[
        Path | None, typer.Option(metavar="DIR", help="Folder for the result bundle.")
    ] = None,
    force: Annotated[
        bool, typer.Option("--force", help="Replace the finished result bundle in --out.")
    ] = False,
    resume: Annotated[
        bool,
        typer.Option("--resume", help="Resume the interrupted run in --out."),
    ] = False,
    as_json: AsJson = False,
) -> None:
    """Evaluate a policy on a suite, and compare it with the human-human baseline.

    With --out, each lift is saved when it is finished, and an interrupted run can be resumed.
    """
    episodes = chosen_suite(suite, seeds, recordings, behaviour).with_timing(
        latency, control_period
    )
    network = chosen_channel(channel)
    if resume and out is None:
        raise InputError("--resume needs the --out of the run that was interrupted")
    if out is not None:
        with naming("--out"):
            check_bundle_folder(out)
        if not (force or resume):
            with naming("--out", hint="--force replaces it"):
                check_unfinished(out)
        if resume and not journal_path(out).exists():
            with naming("--resume", hint="nothing is left to resume"):
                check_unfinished(out)
    check_plays(policy, episodes.scenarios[0].task.name)
    spec = choose_policy(policy, isolation)
    spec.check()
    check_fits(spec, episodes.scenarios[0], episodes.seeds[0])
    verifiable = out is None or Recipe.of(episodes, network) is not None
    if not verifiable:
        print(
            f"note: the result bundle cannot be verified, since suite {episodes.name!r} cannot be "
            f"made again from names: {FROM_NAMES}",
            file=sys.stderr,
        )
    with executor(jobs, dask) as workers:
        there = origin()
        if isinstance(workers, Cluster):
            there = workers.origin
            _mention_idle(workers)
        show_recordings(episodes, as_json)
        with _journal(out, resume, _identity(spec, episodes, network, there)) as journal:
            done, baselines = _evaluate(spec, episodes, network, workers, journal)
            finished = done.complete and baselines.keys() == set(BASELINES)
            content = results(done, baselines) if done.episodes else None
            if content is not None and out is not None:
                write_bundle(out, done, content.plain(), platform=platform_of(there))
            if journal is not None and finished:
                journal.remove()
    if content is not None:
        _print_results(content, episodes, out, verifiable, as_json=as_json)
    if _complain(done, finished=finished, hint="" if out is None else GO_ON):
        raise typer.Exit(1)


def _identity(
    spec: AgentSpec, suite: Suite, channel: Channel | None, there: Mapping[str, str]
) -> dict[str, str]:
    """Return everything that an episode depends on, by name."""
    return {
        "policy": spec.name,
        "policy digest": spec.digest(),
        "suite": suite.name,
        "suite digest": suite.digest,
        "isolation": spec.isolation,
        **({} if channel is None else {"channel": json.dumps(recorded(channel))}),
        **there,
    }


def _journal(
    out: Path | None, resume: bool, identity: Mapping[str, str]
) -> AbstractContextManager[Journal | None]:
    """Return the journal of finished episodes, if a bundle is requested."""
    if out is None:
        return nullcontext()
    journal = open_journal(out, identity, resume=resume)
    return opened(journal, "--resume" if resume else "--out")


def _evaluate(
    spec: AgentSpec,
    suite: Suite,
    channel: Channel | None,
    workers: Executor | None,
    journal: Journal | None,
) -> tuple[Run, Mapping[str, Baseline]]:
    """Run the policy, then the baselines on the same episodes, unless they are shipped."""
    done: Run | None = None
    ready = shipped_baselines(suite)
    total = suite.size * (1 if ready else 1 + len(BASELINES))
    with progress_bar(spec.name, total) as progress:
        play = partial(run_suite, spec, suite, executor=workers, progress=progress, channel=channel)
        try:
            done = play() if journal is None else play(done=journal.done, keep=journal.keep)
            if ready is None:
                ready = play_baselines(suite, executor=workers, progress=progress)
        except KeyboardInterrupt as interrupted:
            if done is None:
                if not isinstance(interrupted, InterruptedRunError):
                    raise
                done = interrupted.run
            return done, (ready or {}) if done.complete else {}
        except EvaluatorFault as fault:
            if journal is None:
                raise
            raise EvaluatorFault(f"{fault}; {GO_ON}") from fault
    return done, ready


def _print_results(
    content: Results, suite: Suite, out: Path | None, verifiable: bool, *, as_json: bool
) -> None:
    """Print the results, as tables and text or as JSON."""
    if as_json:
        print_json({**content.plain(), **recordings_json(suite)})
        return
    show(results_table(content, suite.metrics), results_text(content))
    if out is not None:
        print(f"Result bundle: {out}")
        if content.complete and verifiable:
            print(f"Next: colift verify {argument(out)}")


def _mention_idle(cluster: Cluster) -> None:
    """Report on stderr the threads of a cluster's workers that stay idle."""
    if cluster.idle_threads:
        print(
            f"{cluster.idle_threads} threads of the workers stay idle, since each worker plays one "
            "lift at a time: start workers with dask worker ... --nworkers auto --nthreads 1",
            file=sys.stderr,
        )


def _complain(run: Run, *, finished: bool, hint: str) -> bool:
    """Report failures on stderr; return whether there are any.

    Parameters
    ----------
    run
        The policy's run.
    finished
        Whether the run and the baselines are complete.
    hint
        How to resume an unfinished run.
    """
    for line in (*_faults(run), *reported_failures(run)):
        print(line, file=sys.stderr)
    if not finished:
        parts = (_interrupted(run), hint if run.episodes else "")
        print("; ".join(filter(None, parts)), file=sys.stderr)
    return not finished or any(episode.failure is not None for episode in run.episodes)


def _faults(run: Run) -> Iterator[str]:
    if run.faults:
        again = "1 task was" if run.faults == 1 else f"{run.faults} tasks were"
        yield f"{again} played again because a worker died or a machine failed"


def _interrupted(run: Run) -> str:
    if not run.episodes:
        return "interrupted before the first lift was finished"
    if not run.complete:
        lifts = counted(run.suite.size, "lift")
        return f"interrupted: partial results of {len(run.episodes)} of {lifts}"
    return "interrupted before the baselines were played: there is no comparison"
