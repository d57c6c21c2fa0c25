"""``colift compare``: policies against each other, lift by lift."""

import json
import sys
from collections import Counter
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Annotated

import typer
from rich.console import Console

from ..agents.errors import InputError
from ..agents.registry import POLICIES, entries
from ..benchmark.agent_spec import AgentSpec
from ..benchmark.bounds.play import BOUNDS
from ..benchmark.comparison.comparison import Comparison
from ..benchmark.comparison.comparison import compare as compared
from ..benchmark.comparison.content import comparison_json
from ..benchmark.comparison.contest import Bound, amount, play_contest
from ..benchmark.comparison.words import failures, verdict
from ..benchmark.executors import local_pool
from ..benchmark.suite import Suite
from .compare_tables import behaviours_table, differences_table, ranks_table
from .executors import Jobs
from .policies import choose_policy
from .progress import progress_bar
from .suites import chosen_suite


def compare(
    policies: Annotated[
        list[str] | None,
        typer.Argument(
            metavar="POLICY...",
            help="Names of 'colift list', module:Class, file.py:Class or submissions' folders.",
        ),
    ] = None,
    everything: Annotated[
        bool, typer.Option("--all", help="Every registered policy, beside those that are named.")
    ] = False,
    suite: Annotated[str, typer.Option(help="Scenario suite.")] = "standard-v1",
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
    specs = _specs(policies or [], everything)
    episodes = chosen_suite(suite, seeds, recordings)
    for spec in specs.values():
        spec.check()
    if out is not None:
        # The files need matplotlib, which is slow to load.
        from ..benchmark.comparison.files import check_target, write_comparison

        check_target(out)
    limits = BOUNDS if bounds else {}
    comparison = _compare(specs, episodes, limits, jobs)
    if out is not None:
        write_comparison(out, comparison)
    if as_json:
        print(json.dumps(comparison_json(comparison), indent=2, allow_nan=False))
    else:
        _show(comparison)
        if out is not None:
            Console().print(f"Page: {out / 'compare.html'}", highlight=False, soft_wrap=True)
    told = failures(comparison)
    if told:
        print("\n".join(told), file=sys.stderr)
        raise typer.Exit(1)


def _specs(named: Sequence[str], everything: bool) -> dict[str, AgentSpec]:
    """Return the policies by the names that tables use.

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
    specs = {text: choose_policy(text) for text in texts}
    names = Counter(spec.name for spec in specs.values())
    # Policies of one name are told apart by where they are.
    return {spec.name if names[spec.name] == 1 else text: spec for text, spec in specs.items()}


def _compare(
    specs: Mapping[str, AgentSpec], suite: Suite, bounds: Mapping[str, Bound], jobs: int | None
) -> Comparison:
    """Play the episodes and compare; after Ctrl-C say so and end."""
    try:
        with (
            local_pool(jobs) as pool,
            progress_bar("compare", amount(len(specs), suite, bounds=len(bounds))) as progress,
        ):
            return compared(
                play_contest(specs, suite, bounds=bounds, executor=pool, progress=progress)
            )
    except KeyboardInterrupt:
        print("interrupted: policies are compared on all episodes or not at all", file=sys.stderr)
        raise typer.Exit(1) from None


def _show(comparison: Comparison) -> None:
    console = Console()
    console.print(ranks_table(comparison))
    console.print(differences_table(comparison))
    if len(comparison.behaviours) > 1:
        console.print(behaviours_table(comparison))
    console.print(verdict(comparison), highlight=False)
