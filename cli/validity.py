"""``colift validity``: quality of the suites' predictions of scores with real people."""

import sys
from collections import Counter
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Annotated, Final

import typer
from colift.agents.loading.policy_spec import PolicySpec
from colift.agents.spec import AgentSpec
from colift.agents.submissions.choice import checked_policy
from colift.base.errors import InputError
from colift.base.registry import playing
from colift.benchmark.execution.progress import workers
from colift.benchmark.suites.suite import Suite, make_suite
from colift.benchmark.tables.printing import show
from colift.benchmark.tasks.level.task import LEVEL
from colift.benchmark.validity.playing import (
    Known,
    check_same_task,
    play_source,
    play_suite,
    validity_lifts,
)
from colift.benchmark.validity.report import Validity, check_policies, validity_json, validity_of
from colift.benchmark.validity.scores import Scores
from colift.benchmark.validity.sources import Source, sources_of
from colift.cli.completion import suites as suite_names
from colift.cli.document import print_json
from colift.cli.interrupts import reported_interrupt
from colift.cli.options import AsJson, Jobs, report_left_out, report_notes
from colift.cli.tables.recordings import recordings_json, show_recordings
from colift.cli.tables.validity import MEANINGS, heading, ratios_table, source_table
from colift.leaderboard.practice.shipped_scores import shipped_scores

SUITES: Final = ("standard-v1", "paper-v1", "quick-v1")
"""The suites that are judged by default."""

FLOORS: Final = ("hold", "random")
"""Policies that are left out by default: they come last, by far, on any lifts, so they would raise
a correlation without any merit of the suite."""


def validity(
    data: Annotated[
        list[Path],
        typer.Argument(
            metavar="DATA",
            help="Real lifts: files of recordings (columns trial,t_s,z_m) and sessions of 'colift "
            "play'; each is one source.",
        ),
    ],
    policies: Annotated[
        str | None,
        typer.Option(
            metavar="A,B,...",
            help="Policies as for 'colift run', separated by commas; default: all registered ones "
            f"except {' and '.join(FLOORS)}.",
        ),
    ] = None,
    suite: Annotated[
        list[str] | None,
        typer.Option(
            metavar="NAME",
            help=f"Suite to judge; repeatable. Default: {', '.join(SUITES)}.",
            autocompletion=suite_names,
        ),
    ] = None,
    as_recorded: Annotated[
        bool,
        typer.Option(
            "--as-recorded",
            help="Play recordings at their own height and pace, beside the recorded pairs "
            "themselves where the file has both ends; default: scaled to 0.20 m and slowed down.",
        ),
    ] = False,
    jobs: Jobs = None,
    as_json: AsJson = False,
) -> None:
    """Judge how well suites predict the order and the size of scores on real lifts.

    Example: colift validity lifts.csv
    """
    sources = sources_of(data, as_recorded=as_recorded)
    for path, real in zip(data, sources, strict=True):
        report_notes(path)
        report_left_out(real.name, real.left_out)
    judged = [make_suite(name) for name in dict.fromkeys(suite or SUITES)]
    for each in judged:
        check_same_task(each)
    specs = _chosen(policies)
    found = _play(sources, judged, specs, jobs, as_json)
    if as_json:
        content = validity_json(found)
        for told, source in zip(content["sources"], sources, strict=True):
            told.update(recordings_json(source.suite))
        print_json(content)
    else:
        show(ratios_table(found))
        for judgement in found.sources:
            show(heading(judgement), source_table(judgement))
            show(*judgement.texts, "")
        show(MEANINGS)
    failed = _failures([*(each.source for each in found.sources), *found.suites])
    if failed:
        print("\n".join(failed), file=sys.stderr)
        raise typer.Exit(1)


def separated(text: str) -> list[str]:
    """Return the policies of ``A,B,...``; a part with ``=`` is a parameter of the one before it."""
    found: list[str] = []
    for part in text.split(","):
        if "=" in part and found:
            found[-1] += f",{part}"
        else:
            found.append(part.strip())
    return found


def _chosen(text: str | None) -> dict[str, AgentSpec]:
    """Return the policies, by the names that tables use.

    Raises
    ------
    InputError
        If there are too few, one cannot be loaded, or two have the same name.
    """
    if text is None:
        texts = [name for name in playing(LEVEL.name) if name not in FLOORS]
    else:
        texts = separated(text)
    twice = [each for each, count in Counter(texts).items() if count > 1]
    if twice:
        raise InputError(f"policy {twice[0]} is named twice; name each policy once")
    check_policies(texts)
    specs = {each: checked_policy(each) for each in texts}
    names = Counter(spec.name for spec in specs.values())
    return {spec.name if names[spec.name] == 1 else each: spec for each, spec in specs.items()}


def _play(
    sources: Sequence[Source],
    judged: Sequence[Suite],
    specs: Mapping[str, AgentSpec],
    jobs: int | None,
    as_json: bool,
) -> Validity:
    known = [_known(each, specs) for each in judged]
    total = sum(validity_lifts(specs, *pair) for pair in zip(judged, known, strict=True))
    total += (1 + len(specs)) * sum(source.suite.size for source in sources)
    with (
        reported_interrupt("a suite is judged on all lifts or not at all"),
        workers("validity", total, jobs) as (pool, progress),
    ):
        for each in sources:
            show_recordings(each.suite, as_json, each.name)
        return validity_of(
            [
                (source.kind, play_source(specs, source, executor=pool, progress=progress))
                for source in sources
            ],
            [
                play_suite(specs, each, there, executor=pool, progress=progress)
                for each, there in zip(judged, known, strict=True)
            ],
        )


def _known(suite: Suite, specs: Mapping[str, AgentSpec]) -> Known:
    """Return the shipped scores of colift's own policies without parameters."""
    return {
        name: errors
        for name, errors in shipped_scores(suite).items()
        if specs.get(name) == PolicySpec(text=name)
    }


def _failures(scores: Sequence[Scores]) -> list[str]:
    return [
        f"{name}: {count} of {each.lifts} lifts of {each.name} failed and count as worst"
        for each in scores
        for name, count in each.failed.items()
    ]
