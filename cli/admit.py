"""``colift admit``: whether the lifts of a suite need coordination."""

import dataclasses
from typing import Annotated

import typer
from rich.table import Column

from ..benchmark.admission.admission import admission_of, players
from ..benchmark.admission.criteria import Criterion
from .completion import suites
from .options import AsJson, Jobs, chosen_suite
from .printing import left, print_json, show, table
from .progress import reported_interrupt, workers

WORDS = {True: "passed", False: "FAILED", None: "unknown"}


def admit_suite(
    suite: Annotated[
        str, typer.Argument(metavar="SUITE", help="The suite to test.", autocompletion=suites)
    ],
    jobs: Jobs = None,
    as_json: AsJson = False,
) -> None:
    """Test whether a suite needs coordination: room, interaction, rank changes, people, idling.

    Exit code 1 if a criterion failed.
    """
    episodes = chosen_suite(suite, None, None, None)
    names = players(episodes.scenarios[0].task.name)
    total = (3 + len(names)) * episodes.size
    with (
        reported_interrupt("a suite is tested with all policies or not at all"),
        workers("admit", total, jobs) as (pool, progress),
    ):
        found = admission_of(episodes, names, executor=pool, progress=progress)
    if as_json:
        print_json({**dataclasses.asdict(found), "passed": found.passed})
    else:
        means = sorted(found.means.items(), key=lambda each: each[1])
        show(
            table(
                f"Mean RMSE on {found.suite}",
                ("who", "RMSE mm"),
                ((name, f"{value:.2f}") for name, value in means),
            ),
            table(
                f"Admission of {found.suite}",
                (
                    "",
                    Column("criterion", min_width=30),
                    left("figure"),
                    left("must be"),
                    left("result"),
                ),
                map(_row, found.criteria),
            ),
            "\n".join(f"{each.letter}: {each.detail}" for each in found.criteria),
        )
    if not found.passed:
        raise typer.Exit(1)


def _row(each: Criterion) -> tuple[str, ...]:
    figure = "none" if each.figure is None else f"{each.figure:.2f}"
    return each.letter, each.what, figure, each.bar, WORDS[each.passed]
