"""``colift compare``: a comparison of policies, lift by lift."""

import sys
from collections import Counter
from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import Annotated

import typer
from colift.agents.spec import AUTO, AgentSpec
from colift.agents.submissions.choice import checked_policy
from colift.base.errors import EvaluatorFault, InputError
from colift.base.registry import STANDARD_SUITE, check_plays
from colift.benchmark.comparison.captions import failures, remarks
from colift.benchmark.comparison.compare import Comparison
from colift.benchmark.comparison.compare import compare as compared
from colift.benchmark.comparison.entrants import named_apart
from colift.benchmark.comparison.files import comparison_json
from colift.benchmark.comparison.playing import episodes_to_play, play_policies
from colift.benchmark.comparison.stored import Stored, check_same_lifts, stored_among
from colift.benchmark.comparison.tables import comparison_tables
from colift.benchmark.execution.fitting import check_fits
from colift.benchmark.execution.journal import Journal
from colift.benchmark.execution.progress import progress_bar
from colift.benchmark.references.catalogue import suite_references
from colift.benchmark.rendering.layout import PAGE
from colift.benchmark.suites.policies import playing_on
from colift.benchmark.tables.printing import show
from colift.cli.bundles import mention_others
from colift.cli.completion import policies as named
from colift.cli.completion import suites
from colift.cli.document import print_json
from colift.cli.evaluation import GO_ON, identity, journal_of, origin_of
from colift.cli.interrupts import reported_interrupt
from colift.cli.options import (
    LATENCY_OPTION,
    PERIOD_OPTION,
    AsJson,
    AsTheyWere,
    Behaviours,
    ChannelName,
    Dask,
    InSessions,
    Jobs,
    LayoutName,
    PolicyIsolation,
    Recordings,
    RobotName,
    Seeds,
    chosen_channel,
    chosen_layout,
    chosen_suite,
    executor,
    try_folder,
)
from colift.cli.tables.recordings import show_recordings


def compare_policies(
    policies: Annotated[
        list[str] | None,
        typer.Argument(
            metavar="POLICY",
            help="Policies as for 'colift run', or result bundles of 'colift run --out', which are "
            "not simulated again.",
            autocompletion=named,
        ),
    ] = None,
    everything: Annotated[
        bool, typer.Option("--all", help="All registered policies, besides the named ones.")
    ] = False,
    suite: Annotated[
        str | None,
        typer.Option(
            metavar="NAME",
            help=f"Suite of lifts; default: that of the bundles, else {STANDARD_SUITE}.",
            autocompletion=suites,
        ),
    ] = None,
    behaviour: Behaviours = None,
    seeds: Seeds = None,
    recordings: Recordings = None,
    as_recorded: AsTheyWere = False,
    session: InSessions = False,
    robot: RobotName = None,
    latency: Annotated[float | None, LATENCY_OPTION] = None,
    control_period: Annotated[float | None, PERIOD_OPTION] = None,
    channel: ChannelName = None,
    isolation: PolicyIsolation = AUTO,
    references: Annotated[
        bool,
        typer.Option(
            "--references",
            help="Also play the references, such as the oracle; shipped ones are always shown.",
        ),
    ] = False,
    jobs: Jobs = None,
    dask: Dask = None,
    out: Annotated[
        Path | None,
        typer.Option(
            metavar="DIR",
            help="Folder for compare.html, .csv and .json, the figures (.png, .svg, .pdf), and "
            "compare.tex and .bib for LaTeX.",
        ),
    ] = None,
    layout: LayoutName = PAGE.name,
    resume: Annotated[
        bool,
        typer.Option("--resume", help="Resume the interrupted comparison in --out."),
    ] = False,
    as_json: AsJson = False,
) -> None:
    """Compare policies on the same lifts: ranks, paired differences, and RMSE per behaviour.

    With --out, each lift is saved when it is finished, and an interrupted comparison can be
    resumed.

    Example: colift compare copy blend anticipate --suite quick-v1
    """
    if resume and out is None:
        raise InputError("--resume needs the --out of the comparison that was interrupted")
    named = policies or []
    bundles = stored_among(named)
    if bundles and not (
        suite or seeds or recordings or as_recorded or session or behaviour or robot
    ):
        episodes = next(iter(bundles.values())).suite
    else:
        episodes = chosen_suite(
            suite, seeds, recordings, behaviour, robot, as_recorded=as_recorded, session=session
        )
    episodes = episodes.with_timing(latency, control_period)
    task = episodes.scenarios[0].task.name
    specs, stored = _policies(
        named,
        playing_on(episodes) if everything else (),
        bundles,
        task,
        isolation,
    )
    for folder in bundles:
        mention_others(Path(folder))
    network = chosen_channel(channel)
    if network is None and stored:
        network = stored[0].channel
    check_same_lifts(stored, episodes, network)
    for spec in specs.values():
        check_fits(spec, episodes.scenarios[0], episodes.seeds[0])
    size = chosen_layout(layout)
    if out is not None:
        # The files need matplotlib, which is slow to load.
        from colift.benchmark.comparison.files import write_comparison

        try_folder("--out", out)
        out.parent.mkdir(parents=True, exist_ok=True)  # The journal is beside the folder.
    limits = suite_references(episodes) if references else {}
    results = [each.policy for each in stored]
    total = episodes_to_play(len(specs), episodes, references=len(limits))
    with executor(jobs, dask) as pool, progress_bar("compare", total) as progress:
        there = origin_of(pool)
        show_recordings(episodes, as_json)
        who = identity([*specs.values()], episodes, network, there)
        with journal_of(out, who, resume=resume) as journal, _kept(journal):
            comparison = compared(
                play_policies(
                    specs,
                    episodes,
                    stored=results,
                    references=limits,
                    executor=pool,
                    progress=progress,
                    channel=network,
                    journal=journal,
                )
            )
            if out is not None:
                write_comparison(out, comparison, size)
            if journal is not None:
                journal.remove()
    if as_json:
        print_json(comparison_json(comparison))
    else:
        _show(comparison)
        for each in stored:
            print(f"{each.policy.name}: from {each.origin}, not simulated again")
        if out is not None:
            print(f"Page: {out / 'compare.html'}")
    failed = failures(comparison)
    if failed:
        print("\n".join(failed), file=sys.stderr)
        raise typer.Exit(1)


def _policies(
    named: Sequence[str],
    others: Iterable[str],
    stored: Mapping[str, Stored],
    task: str,
    isolation: str,
) -> tuple[dict[str, AgentSpec], list[Stored]]:
    """Return the policies to play, by the names that tables use, and the stored results.

    Raises
    ------
    InputError
        If there are fewer than two, stored ones included, one is named twice, or one is for another
        task.
    """
    twice = [text for text, count in Counter(named).items() if count > 1]
    if twice:
        raise InputError(f"policy {twice[0]} is named twice; name each policy once")
    texts = list(dict.fromkeys([*named, *others]))
    if len(texts) < 2:
        given = f"only {texts[0]}" if texts else "none"
        raise InputError(f"name at least two policies, or --all: {given} was named")
    for text in texts:
        check_plays(text, task)
    specs = {text: checked_policy(text, isolation) for text in texts if text not in stored}
    return named_apart(specs, stored)


@contextmanager
def _kept(journal: Journal | None) -> Iterator[None]:
    """End the command with a message if Ctrl-C is pressed or the machine fails in the body."""
    lost = "policies are compared on all lifts or not at all; --out would keep the finished ones"
    try:
        with reported_interrupt(lost if journal is None else GO_ON):
            yield
    except EvaluatorFault as fault:
        if journal is None:
            raise
        raise EvaluatorFault(f"{fault}; {GO_ON}") from fault


def _show(comparison: Comparison) -> None:
    show(*comparison_tables(comparison), *remarks(comparison))
