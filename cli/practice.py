"""``colift practice``: evaluation of colift's own policies in the practice seasons."""

import dataclasses
import sys
from concurrent.futures import Executor
from datetime import UTC, datetime
from functools import partial
from pathlib import Path
from typing import Annotated

import typer
from colift.base.errors import EvaluatorFault, InputError
from colift.benchmark.execution.progress import job_bar
from colift.benchmark.references.catalogue import suite_references
from colift.benchmark.suites.policies import made_for_suite
from colift.benchmark.tables.printing import show, table
from colift.cli.interrupts import reported_interrupt
from colift.cli.options import Dask, Jobs, executor
from colift.leaderboard.evaluation.evaluate import (
    episode_count,
    play_human_human,
    play_season_references,
)
from colift.leaderboard.evaluation.progress import Callbacks
from colift.leaderboard.practice.season import SUITES, is_current, play_policy, practice_season
from colift.leaderboard.practice.season_import import PlayedSeason
from colift.leaderboard.records.season import Season
from rich.table import Table


def practice(
    out: Annotated[
        Path,
        typer.Option(metavar="DIR", help="Folder for the files; leaderboard/data in a clone."),
    ],
    suite: Annotated[
        list[str] | None, typer.Option(metavar="NAME", help="A suite; repeatable. Default: all.")
    ] = None,
    policy: Annotated[
        list[str] | None,
        typer.Option(metavar="NAME", help="A policy of colift; repeatable. Default: all."),
    ] = None,
    fresh: Annotated[
        bool, typer.Option("--fresh", help="Evaluate again even the entries that are current.")
    ] = False,
    jobs: Jobs = None,
    dask: Dask = None,
) -> None:
    """Evaluate colift's own policies in the practice seasons, whose secrets are public.

    Each policy is saved when it is finished: the same command continues after an interruption. The
    references are played once, and again with --fresh.

    Example: colift practice --suite robust-v1 --out practice
    """
    if not out.is_dir():
        raise InputError(f"cannot write to {out}: there is no such folder")
    seasons = [practice_season(name) for name in suite or SUITES]
    chosen = {season.name: _chosen(policy, season) for season in seasons}
    refused = False
    with executor(jobs, dask) as pool:
        for season in seasons:
            names = chosen[season.name]
            with reported_interrupt("the same command continues"):
                shipped, faults = _season(season, names, out, pool, fresh)
            refused |= bool(faults)
            show(_table(season, shipped))
            for fault in faults:
                print(f"error: {fault}", file=sys.stderr)
    if refused:
        raise typer.Exit(1)


def _chosen(names: list[str] | None, season: Season) -> list[str]:
    """Return the policies to evaluate in a season: the named ones, or all made for its task."""
    own = made_for_suite(season.suite)
    unknown = [name for name in names or () if name not in own]
    if unknown:
        raise InputError(
            f"colift has no policy {unknown[0]!r} of its own for {season.suite.name}; it has "
            f"{', '.join(own)}"
        )
    return names or list(own)


def _season(
    season: Season, names: list[str], out: Path, pool: Executor | None, fresh: bool
) -> tuple[PlayedSeason, list[EvaluatorFault]]:
    """Evaluate the missing entries; return all entries, and the faults of the machine."""
    there = PlayedSeason.read(season.suite.name, out)
    if there is None or there.suite_digest != season.suite.digest:
        there = None
    done = [] if there is None or fresh else [p for p in there.played if is_current(p, season)]
    todo = [name for name in names if name not in {each.entry.name for each in done}]
    beside = there is None or fresh or not there.references
    once = (season.suite.size if there is None else 0) + (
        len(suite_references(season.hidden)) * season.hidden.size if beside else 0
    )
    total = len(todo) * episode_count(season) + once
    faults = []
    with job_bar(season.name, total) as bar:

        def stage(policy: str, name: str) -> None:
            bar.stage(f"{season.name}: {policy}, {name}")

        if there is None:
            watch = Callbacks(stage=partial(stage, "all"), progress=bar.advance)
            human_human = play_human_human(season, executor=pool, watch=watch)
            there = PlayedSeason(
                suite=season.suite.name,
                suite_digest=season.suite.digest,
                began_at=datetime.now(UTC),
                human_human=human_human,
                references={},
                played=(),
            )
        if beside:
            stage("all", "references")
            there = dataclasses.replace(
                there,
                references=play_season_references(season, executor=pool, progress=bar.advance),
            )
            there.write(out)
        for name in todo:
            watch = Callbacks(stage=partial(stage, name), progress=bar.advance)
            try:
                now = datetime.now(UTC)
                new = play_policy(name, season, there.human_human, now, executor=pool, watch=watch)
            except EvaluatorFault as fault:
                faults.append(fault)
                continue
            there = there.with_played(new)
            there.write(out)
    return there, faults


def _table(season: Season, shipped: PlayedSeason) -> Table:
    rows = [each.entry.row for each in shipped.played if each.entry.row is not None]
    return table(
        f"Season {season.name} on {season.suite.name}",
        ("policy", "public RMSE mm", "hidden RMSE mm", "hidden vs human"),
        (
            (
                row.name,
                f"{row.public.rmse_mm.mean:.2f}",
                f"{row.hidden.rmse_mm.mean:.2f}",
                f"{row.hidden.vs_human.mean:.2f}",
            )
            for row in sorted(rows, key=lambda row: row.hidden.rmse_mm.mean)
        ),
    )
