"""``colift compare``: policies against each other, lift by lift."""

import dataclasses
import json
import sys
from collections import Counter
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Annotated

import typer

from ..agents.errors import InputError
from ..agents.registry import POLICIES, entries
from ..agents.spec import AgentSpec
from ..benchmark.bounds.causal import BOUNDS
from ..benchmark.comparison.comparison import Comparison
from ..benchmark.comparison.comparison import compare as compared
from ..benchmark.comparison.contest import (
    Bound,
    Entry,
    Stored,
    amount,
    check_suite,
    is_bundle,
    play_contest,
    read_stored,
)
from ..benchmark.comparison.files import comparison_json
from ..benchmark.comparison.words import failures, oddities, verdict
from ..benchmark.execution.pool import local_pool
from ..benchmark.suites.suite import Suite
from .completion import policies as named
from .completion import suites
from .options import STANDARD, Jobs, check_folder, chosen_suite
from .policies import choose_policy
from .printing import show
from .progress import progress_bar
from .tables.comparison import behaviours_table, differences_table, ranks_table


def compare_policies(
    policies: Annotated[
        list[str] | None,
        typer.Argument(
            metavar="POLICY...",
            help="Names of 'colift list', module:Class, file.py:Class, submissions' folders; or "
            "result bundles of colift run --out, which are not played again.",
            autocompletion=named,
        ),
    ] = None,
    everything: Annotated[
        bool, typer.Option("--all", help="Every registered policy, beside those that are named.")
    ] = False,
    suite: Annotated[
        str | None,
        typer.Option(
            help="Scenario suite; default: that of the bundles, else standard-v1.",
            autocompletion=suites,
        ),
    ] = None,
    seeds: Annotated[
        str | None, typer.Option(metavar="A:B", help="Seeds A to B-1 instead of the suite's.")
    ] = None,
    recordings: Annotated[
        Path | None,
        typer.Option(metavar="CSV", help="Recorded lifts (trial,t_s,z_m) instead of a suite."),
    ] = None,
    bounds: Annotated[
        bool,
        typer.Option(
            "--bounds",
            help="Play the oracle and the causal bound, too; whole suites show them anyway.",
        ),
    ] = False,
    jobs: Jobs = None,
    out: Annotated[
        Path | None,
        typer.Option(metavar="DIR", help="Where to write compare.html, .png, .csv and .json."),
    ] = None,
    as_json: Annotated[
        bool, typer.Option("--json", help="Print compare.json alone, and nothing else.")
    ] = False,
) -> None:
    """Compare policies on the same lifts: ranks, paired differences, and who wins where."""
    specs, stored = _named(policies or [], everything)
    if stored and not (suite or seeds or recordings):
        episodes = stored[0].suite
    else:
        episodes = chosen_suite(suite or STANDARD, seeds, recordings)
    check_suite(stored, episodes)
    for spec in specs.values():
        spec.check()
    if out is not None:
        # The files need matplotlib, which is slow to load.
        from ..benchmark.comparison.files import write_comparison

        check_folder("--out", out)
    limits = BOUNDS if bounds else {}
    comparison = _compare(specs, [each.entry for each in stored], episodes, limits, jobs)
    if out is not None:
        write_comparison(out, comparison)
    if as_json:
        print(json.dumps(comparison_json(comparison), indent=2, allow_nan=False))
    else:
        _show(comparison)
        for each in stored:
            print(f"{each.entry.name}: as {each.folder} has it, not simulated again here")
        if out is not None:
            print(f"Page: {out / 'compare.html'}")
    told = failures(comparison)
    if told:
        print("\n".join(told), file=sys.stderr)
        raise typer.Exit(1)


def _named(named: Sequence[str], everything: bool) -> tuple[dict[str, AgentSpec], list[Stored]]:
    """Return the policies to play, by the names that tables use, and those that have played.

    Raises
    ------
    InputError
        If there are fewer than two, or one is named twice.
    """
    twice = [text for text, count in Counter(named).items() if count > 1]
    if twice:
        raise InputError(f"policy {twice[0]} is named twice; name each policy once")
    texts = list(dict.fromkeys([*named, *(entries(POLICIES) if everything else ())]))
    if len(texts) < 2:
        told = f"only {texts[0]}" if texts else "none"
        raise InputError(f"name at least two policies, or --all: {told} was named")
    registered = entries(POLICIES)
    stored = {
        text: read_stored(Path(text))
        for text in texts
        if text not in registered and is_bundle(Path(text))
    }
    specs = {text: choose_policy(text) for text in texts if text not in stored}
    names = Counter(spec.name for spec in specs.values())
    names.update(each.entry.name for each in stored.values())
    # Policies of one name are told apart by where they are.
    called = {spec.name if names[spec.name] == 1 else text: spec for text, spec in specs.items()}
    return called, [
        each
        if names[each.entry.name] == 1
        else dataclasses.replace(each, entry=dataclasses.replace(each.entry, name=text))
        for text, each in stored.items()
    ]


def _compare(
    specs: Mapping[str, AgentSpec],
    stored: Sequence[Entry],
    suite: Suite,
    bounds: Mapping[str, Bound],
    jobs: int | None,
) -> Comparison:
    """Play the episodes and compare; after Ctrl-C say so and end."""
    try:
        with (
            local_pool(jobs) as pool,
            progress_bar("compare", amount(len(specs), suite, bounds=len(bounds))) as progress,
        ):
            return compared(
                play_contest(
                    specs, suite, stored=stored, bounds=bounds, executor=pool, progress=progress
                )
            )
    except KeyboardInterrupt:
        print("interrupted: policies are compared on all lifts or not at all", file=sys.stderr)
        raise typer.Exit(1) from None


def _show(comparison: Comparison) -> None:
    show(ranks_table(comparison), differences_table(comparison))
    if len(comparison.behaviours) > 1:
        show(behaviours_table(comparison))
    show(verdict(comparison), *oddities(comparison))
