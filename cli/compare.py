"""``colift compare``: a comparison of policies, lift by lift."""

import dataclasses
import sys
from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from typing import Annotated

import typer
from colift.agents.spec import AgentSpec
from colift.agents.submissions.choice import checked_policy
from colift.base.errors import InputError
from colift.base.registry import POLICIES, STANDARD_SUITE, check_plays, entries, playing
from colift.benchmark.bundle import is_bundle
from colift.benchmark.channels import Channel
from colift.benchmark.comparison.captions import failures, goals, roughness, unit_warnings, verdict
from colift.benchmark.comparison.compare import Comparison
from colift.benchmark.comparison.compare import compare as compared
from colift.benchmark.comparison.files import comparison_json
from colift.benchmark.comparison.paired_results import PolicyResults
from colift.benchmark.comparison.playing import Reference, episodes_to_play, play_policies
from colift.benchmark.comparison.stored import Stored, check_same_lifts, read_stored
from colift.benchmark.execution.fitting import check_fits
from colift.benchmark.execution.progress import workers
from colift.benchmark.references.catalogue import suite_references
from colift.benchmark.suites.suite import Suite
from colift.benchmark.tables.printing import show
from colift.cli.bundles import mention_others
from colift.cli.completion import policies as named
from colift.cli.completion import suites
from colift.cli.document import print_json
from colift.cli.interrupts import reported_interrupt
from colift.cli.options import (
    AsJson,
    Behaviours,
    ChannelName,
    Jobs,
    Recordings,
    RobotName,
    Seeds,
    chosen_channel,
    chosen_suite,
    try_folder,
)
from colift.cli.tables.comparison import behaviours_table, differences_table, ranks_table
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
    robot: RobotName = None,
    channel: ChannelName = None,
    references: Annotated[
        bool,
        typer.Option(
            "--references",
            help="Also play the references, such as the oracle; shipped ones are always shown.",
        ),
    ] = False,
    jobs: Jobs = None,
    out: Annotated[
        Path | None,
        typer.Option(metavar="DIR", help="Folder for compare.html, .png, .csv and .json."),
    ] = None,
    as_json: AsJson = False,
) -> None:
    """Compare policies on the same lifts: ranks, paired differences, and RMSE per behaviour.

    Example: colift compare copy blend anticipate --suite quick-v1
    """
    named = policies or []
    bundles = _stored(named)
    if bundles and not (suite or seeds or recordings or behaviour or robot):
        episodes = next(iter(bundles.values())).suite
    else:
        episodes = chosen_suite(suite, seeds, recordings, behaviour, robot)
    task = episodes.scenarios[0].task.name
    specs, stored = _policies(named, playing(task) if everything else (), bundles, task)
    for each in stored:
        mention_others(each.folder)
    network = chosen_channel(channel)
    if network is None and stored:
        network = stored[0].channel
    check_same_lifts(stored, episodes, network)
    for spec in specs.values():
        check_fits(spec, episodes.scenarios[0], episodes.seeds[0])
    if out is not None:
        # The files need matplotlib, which is slow to load.
        from colift.benchmark.comparison.files import write_comparison

        try_folder("--out", out)
    limits = suite_references(episodes) if references else {}
    results = [each.policy for each in stored]
    comparison = _compare(specs, results, episodes, limits, network, jobs, as_json)
    if out is not None:
        write_comparison(out, comparison)
    if as_json:
        print_json(comparison_json(comparison))
    else:
        _show(comparison)
        for each in stored:
            print(f"{each.policy.name}: from {each.folder}, not simulated again")
        if out is not None:
            print(f"Page: {out / 'compare.html'}")
    failed = failures(comparison)
    if failed:
        print("\n".join(failed), file=sys.stderr)
        raise typer.Exit(1)


def _stored(named: Sequence[str]) -> dict[str, Stored]:
    """Return the stored results among the named policies, by their folders."""
    return {
        text: read_stored(Path(text))
        for text in named
        if text not in entries(POLICIES) and is_bundle(Path(text))
    }


def _policies(
    named: Sequence[str], others: Iterable[str], stored: Mapping[str, Stored], task: str
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
    specs = {text: checked_policy(text) for text in texts if text not in stored}
    names = Counter(spec.name for spec in specs.values())
    names.update(each.policy.name for each in stored.values())
    # Policies of the same name are distinguished by their place.
    called = {spec.name if names[spec.name] == 1 else text: spec for text, spec in specs.items()}
    return called, [
        each
        if names[each.policy.name] == 1
        else dataclasses.replace(each, policy=dataclasses.replace(each.policy, name=text))
        for text, each in stored.items()
    ]


def _compare(
    specs: Mapping[str, AgentSpec],
    stored: Sequence[PolicyResults],
    suite: Suite,
    references: Mapping[str, Reference],
    channel: Channel | None,
    jobs: int | None,
    as_json: bool,
) -> Comparison:
    """Play the episodes and compare."""
    total = episodes_to_play(len(specs), suite, references=len(references))
    with (
        reported_interrupt("policies are compared on all lifts or not at all"),
        workers("compare", total, jobs) as (pool, progress),
    ):
        show_recordings(suite, as_json)
        results = play_policies(
            specs,
            suite,
            stored=stored,
            references=references,
            executor=pool,
            progress=progress,
            channel=channel,
        )
        return compared(results)


def _show(comparison: Comparison) -> None:
    show(ranks_table(comparison), differences_table(comparison))
    if len(comparison.behaviours) > 1:
        show(behaviours_table(comparison))
    show(
        verdict(comparison),
        *roughness(comparison),
        *goals(comparison),
        *unit_warnings(comparison),
    )
