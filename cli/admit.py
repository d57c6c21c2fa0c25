"""``colift admit``: a test of whether the lifts of a suite need coordination."""

import dataclasses
from typing import Annotated

import numpy as np
import typer
from colift.base.errors import InputError
from colift.benchmark.admission.assessment import Admission, admission_of, players
from colift.benchmark.admission.criteria import Criterion
from colift.benchmark.execution.progress import job_bar, workers
from colift.benchmark.references.catalogue import suite_references
from colift.benchmark.results.baselines import shipped_references
from colift.benchmark.tables.printing import left, show, table
from colift.benchmark.training.apg_settings import pair_settings
from colift.benchmark.twin.libraries import require_jax
from colift.cli.completion import suites
from colift.cli.document import print_json
from colift.cli.interrupts import reported_interrupt
from colift.cli.options import AsJson, Jobs, chosen_suite
from numpy.typing import NDArray
from rich.table import Column, Table

MOST_PAIRS = 20

WORDS = {True: "passed", False: "FAILED", None: "unknown"}


def admit_suite(
    suite: Annotated[
        str, typer.Argument(metavar="SUITE", help="The suite to test.", autocompletion=suites)
    ],
    pairs: Annotated[
        int,
        typer.Option(
            metavar="N", help="Pairs to train in the twin, for criterion d (extra: train)."
        ),
    ] = 0,
    jobs: Jobs = None,
    as_json: AsJson = False,
) -> None:
    """Test by six criteria whether the lifts of a suite need coordination.

    Exit code 1 if a criterion failed.
    """
    episodes = chosen_suite(suite, None, None, None)
    played = _cross_play(episodes.scenarios[0].task.name, pairs) if pairs else None
    names = players(episodes.scenarios[0].task.name)
    references = 0 if shipped_references(episodes) else len(suite_references(episodes))
    total = (2 + references + len(names)) * episodes.size
    with (
        reported_interrupt("a suite is tested with all policies or not at all"),
        workers("admit", total, jobs) as (pool, progress),
    ):
        found = admission_of(episodes, names, pairs=played, executor=pool, progress=progress)
    if as_json:
        print_json({**dataclasses.asdict(found), "passed": found.passed})
    else:
        show(
            _means(found),
            table(
                f"Admission of {found.suite}",
                (
                    "",
                    Column("criterion", min_width=24),
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


def _cross_play(task: str, count: int) -> NDArray[np.float64]:
    """Train pairs, and return the error of each person with each robot."""
    if not 2 <= count <= MOST_PAIRS:
        raise InputError(f"--pairs must be 2 to {MOST_PAIRS}, or 0 for none; got {count}")
    settings = pair_settings(task)
    require_jax()
    from colift.benchmark.training.pairs import cross_play

    with job_bar("pairs", count * settings.updates) as bar:
        return cross_play(count, settings, bar.advance)


def _means(found: Admission) -> Table:
    """Return the mean errors of policies, baselines and references, with all and with each."""
    people = dict.fromkeys(name for means in found.by_person.values() for name in means)
    means = sorted(found.means.items(), key=lambda each: each[1])
    rows = (
        (name, f"{mean:.2f}", *(f"{found.by_person[name][each]:.1f}" for each in people))
        for name, mean in means
    )
    return table(f"Mean RMSE on {found.suite}, mm", ("who", "all", *people), rows)


def _row(each: Criterion) -> tuple[str, ...]:
    figure = "none" if each.figure is None else f"{each.figure:.2f}"
    return each.letter, each.what, figure, each.bar, WORDS[each.passed]
