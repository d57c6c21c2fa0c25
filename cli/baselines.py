"""``colift baselines``: the baselines and references of all suites."""

from pathlib import Path
from typing import Annotated

import typer
from colift.base.registry import SUITES, own_entries
from colift.benchmark.comparison.formatting import between
from colift.benchmark.comparison.playing import play_references
from colift.benchmark.execution.progress import workers
from colift.benchmark.references.catalogue import suite_references
from colift.benchmark.results.baselines import (
    BASELINES,
    ToShip,
    baselines_json,
    play_baselines,
    shipped_content,
)
from colift.benchmark.suites.suite import make_suite
from colift.benchmark.tables.printing import left, show, table
from colift.cli.completion import suites as named
from colift.cli.options import Jobs, check_new_file, write_output


def baselines(
    out: Annotated[
        Path | None,
        typer.Option(
            metavar="FILE", help="New JSON file for the results, in the form colift ships."
        ),
    ] = None,
    only: Annotated[
        list[str] | None,
        typer.Option(
            "--suite",
            metavar="NAME",
            help="Suite to play; repeatable. In the file, other suites keep their shipped results. "
            "Default: all of colift's own.",
            autocompletion=named,
        ),
    ] = None,
    jobs: Jobs = None,
) -> None:
    """Play the baselines and the references on suites, and print their RMSE per behaviour.

    Example: colift baselines --suite quick-v1 --out baselines.json
    """
    check_new_file(out, ".json")
    suites = [make_suite(name) for name in only or own_entries(SUITES)]
    total = sum((len(BASELINES) + len(suite_references(suite))) * suite.size for suite in suites)
    played: list[ToShip] = []
    with workers("baselines", total, jobs) as (pool, progress):
        for suite in suites:
            baselines = play_baselines(suite, executor=pool, progress=progress)
            references = play_references(
                suite_references(suite), suite, executor=pool, progress=progress
            )
            played.append(ToShip(suite=suite, baselines=baselines, references=references))
    rows = [
        (each.suite.name, name, behaviour or "all", f"{error.mean:.2f}", between(error.ci95, ".2f"))
        for each in played
        for name, baseline in {**each.baselines, **each.references}.items()
        for behaviour in (*dict.fromkeys(key[0] for key in baseline.strata), None)
        for error in (baseline.part(behaviour).error,)
    ]
    titles = ("suite", left("baseline"), left("human"), "RMSE mm", "95 % interval")
    show(table("", titles, rows))
    kept = shipped_content() if only else {}
    write_output(out, baselines_json(played, kept))
