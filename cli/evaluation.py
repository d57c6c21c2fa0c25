"""The evaluation that ``colift run`` makes: its checks, its lifts, its output."""

import json
import sys
from collections.abc import Iterator, Mapping, Sequence
from concurrent.futures import Executor
from contextlib import AbstractContextManager, nullcontext
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Final

import typer
from colift.agents.spec import AgentSpec
from colift.agents.submissions.choice import checked_policy
from colift.agents.submissions.hints import board_remarks
from colift.base.errors import EvaluatorFault, InputError
from colift.base.registry import check_plays
from colift.benchmark.bundle import (
    Results,
    check_bundle_folder,
    check_unfinished,
    results,
    write_bundle,
)
from colift.benchmark.bundle.recipe import FROM_NAMES, Recipe
from colift.benchmark.channels import Channel
from colift.benchmark.channels.recorded import recorded
from colift.benchmark.execution.cluster import Cluster
from colift.benchmark.execution.fitting import check_fits
from colift.benchmark.execution.journal import Journal, journal_path, open_journal
from colift.benchmark.execution.progress import progress_bar
from colift.benchmark.execution.provenance import origin, platform_of
from colift.benchmark.execution.runner import InterruptedRunError, Run, run_suite
from colift.benchmark.results.baselines import (
    BASELINES,
    HUMAN_HUMAN,
    play_baselines,
    shipped_baselines,
)
from colift.benchmark.results.remarks import remarks
from colift.benchmark.results.scores import ScoreTable
from colift.benchmark.suites.suite import Suite
from colift.benchmark.tables.failures import DeadPolicyError, LifeWatch, reported_failures
from colift.benchmark.tables.printing import counted, show
from colift.benchmark.tables.results_table import results_table, results_text
from colift.cli.document import print_json
from colift.cli.loading import INTERRUPTED
from colift.cli.remedies import argument, naming, opened
from colift.cli.tables.recordings import recordings_json, show_recordings

GO_ON: Final = "the finished lifts are kept: resume with the same command and --resume"


@dataclass(frozen=True)
class Bundle:
    """The result bundle of a run: where, and what is done with one that is there."""

    folder: Path | None
    force: bool
    resume: bool

    def check(self) -> None:
        """Refuse a folder that cannot be written, before any lift is played."""
        if self.folder is None:
            if self.resume:
                raise InputError("--resume needs the --out of the run that was interrupted")
            return
        with naming("--out"):
            check_bundle_folder(self.folder)
        if not (self.force or self.resume):
            with naming("--out", hint="--force replaces it"):
                check_unfinished(self.folder)
        if self.resume and not journal_path(self.folder).exists():
            with naming("--resume", hint="nothing is left to resume"):
                check_unfinished(self.folder)

    def journal(self, identity: Mapping[str, str]) -> AbstractContextManager[Journal | None]:
        """Return the journal of finished episodes, if a bundle is requested."""
        return journal_of(self.folder, identity, resume=self.resume)


def journal_of(
    folder: Path | None, identity: Mapping[str, str], *, resume: bool
) -> AbstractContextManager[Journal | None]:
    """Return the journal of ``--out``, see :func:`.open_journal`; None without a folder."""
    if folder is None:
        return nullcontext()
    journal = open_journal(folder, identity, resume=resume)
    return opened(journal, "--resume" if resume else "--out")


def evaluate(
    text: str,
    isolation: str,
    suite: Suite,
    channel: Channel | None,
    pool: AbstractContextManager[Executor | None],
    bundle: Bundle,
    *,
    as_json: bool,
) -> None:
    """Play a policy on a suite, write the bundle, and print the results.

    Parameters
    ----------
    text, isolation
        The policy, and its isolation; see :func:`.checked_policy`.
    suite, channel
        The lifts, and the channel between robot and policy; None for none.
    pool
        Yields the executor of the lifts.
    bundle
        The result bundle, checked.
    as_json
        Whether to print JSON.

    Raises
    ------
    InputError, EvaluatorFault
        If the policy or the bundle cannot be used; if the machine failed.
    typer.Exit
        If a lift failed, or after Ctrl-C.
    """
    check_plays(text, suite.scenarios[0].task.name)
    spec = checked_policy(text, isolation)
    check_fits(spec, suite.scenarios[0], suite.seeds[0])
    for remark in board_remarks(text):
        print(f"note: {remark}", file=sys.stderr)
    out = bundle.folder
    verifiable = out is None or Recipe.of(suite, channel) is not None
    if not verifiable:
        print(
            f"note: the result bundle cannot be verified, since suite {suite.name!r} cannot be "
            f"made again from names: {FROM_NAMES}",
            file=sys.stderr,
        )
    with pool as workers:
        there = origin_of(workers)
        show_recordings(suite, as_json)
        with bundle.journal(identity([spec], suite, channel, there)) as journal:
            try:
                done, baselines = _evaluate(spec, suite, channel, workers, journal)
            except DeadPolicyError as dead:
                if journal is not None:
                    journal.remove()
                _report_dead(dead, spec, suite, channel, as_json=as_json)
                raise typer.Exit(1) from dead
            finished = done.complete and baselines.keys() == set(BASELINES)
            content = results(done, baselines) if done.episodes else None
            if content is not None and out is not None:
                write_bundle(
                    out,
                    done,
                    content.plain(),
                    human_human=baselines.get(HUMAN_HUMAN),
                    platform=platform_of(there),
                )
            if journal is not None and finished:
                journal.remove()
    if content is not None:
        _print_results(content, suite, out, verifiable, as_json=as_json)
    if _complain(done, finished=finished, hint="" if out is None else GO_ON):
        raise typer.Exit(1 if finished else INTERRUPTED)


def origin_of(workers: Executor | None) -> Mapping[str, str]:
    """Return the origin of the lifts that an executor plays; report idle threads of a cluster."""
    if not isinstance(workers, Cluster):
        return origin()
    _mention_idle(workers)
    return workers.origin


def identity(
    policies: Sequence[AgentSpec],
    suite: Suite,
    channel: Channel | None,
    there: Mapping[str, str],
) -> dict[str, str]:
    """Return everything that the episodes of some policies depend on, by name."""
    return {
        "policy": ", ".join(each.name for each in policies),
        "policy digest": ", ".join(each.digest() for each in policies),
        "suite": suite.name,
        "suite digest": suite.digest,
        "isolation": ", ".join(dict.fromkeys(each.isolation for each in policies)),
        **({} if channel is None else {"channel": json.dumps(recorded(channel))}),
        **there,
    }


def _evaluate(
    spec: AgentSpec,
    suite: Suite,
    channel: Channel | None,
    workers: Executor | None,
    journal: Journal | None,
) -> tuple[Run, Mapping[str, ScoreTable]]:
    """Run the policy, then the baselines on the same episodes, unless they are shipped.

    Raise a DeadPolicyError if all of the first lifts fail at once.
    """
    done: Run | None = None
    ready = shipped_baselines(suite)
    total = suite.size * (1 if ready else 1 + len(BASELINES))
    before = journal.done if journal is not None else {}
    with progress_bar(spec.name, total) as progress:
        play = partial(run_suite, spec, suite, executor=workers, progress=progress, channel=channel)
        try:
            done = play(done=before, keep=LifeWatch(), shelf=journal)
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
    show(results_table(content, suite.metrics), results_text(content, suite.metrics))
    if content.complete and not content.summary.failed:
        show(*remarks(content.summary, content.baselines))
    if out is not None:
        print(f"Result bundle: {out}")
        if content.complete and verifiable:
            print(f"Next: colift verify {argument(out)}")


def _report_dead(
    dead: DeadPolicyError,
    spec: AgentSpec,
    suite: Suite,
    channel: Channel | None,
    *,
    as_json: bool,
) -> None:
    """Report a policy whose first lifts all failed at once; there is no table of the worst."""
    run = Run(
        policy=spec.name,
        policy_digest=spec.digest(),
        suite=suite,
        episodes=dead.episodes,
        isolation=spec.isolation,
        channel=channel,
    )
    if as_json:
        print_json(results(run, {}).plain())
    lifts = counted(len(run.episodes), "lift")
    print(f"stopped: the policy fails at once in each of the first {lifts}", file=sys.stderr)
    for line in reported_failures(run):
        print(line, file=sys.stderr)


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
        text = f"interrupted: partial results of {len(run.episodes)} of {lifts}"
        played = {each.behaviour for each in run.episodes}
        every = {each.behaviour for each in run.suite.scenarios}
        return text if played == every else f"{text}, of {', '.join(sorted(played))} alone"
    return "interrupted before the baselines were played: there is no comparison"
