"""``colift statistics``: coverage of intervals and false differences, with people drawn anew."""

import dataclasses
from typing import Annotated, Final

import typer
from colift.benchmark.execution.progress import job_bar
from colift.benchmark.statistics.simulation import (
    BOARD_SAMPLES,
    BOARDS,
    LEAST_COVERAGE,
    MOST_SPLITS,
    SAMPLES,
    Coverage,
    Splits,
    coverage,
    false_splits,
)
from colift.benchmark.tables.printing import left, show, table
from colift.cli.document import print_json
from colift.cli.interrupts import reported_interrupt
from colift.cli.options import AsJson
from rich.table import Table

REPETITIONS: Final = 1000
"""Suites of each size, and boards of each kind: standard errors of 0.7 percentage points."""

FEWEST: Final = 20
"""Fewest repetitions of a share."""


def check_statistics(
    repetitions: Annotated[
        int,
        typer.Option(metavar="N", help="Suites of each size, and boards of each kind.", min=FEWEST),
    ] = REPETITIONS,
    seed: Annotated[int, typer.Option(metavar="N", help="Seed of the draws.", min=0)] = 0,
    check: Annotated[
        bool,
        typer.Option(
            "--check",
            help=f"Exit with code 1 if a coverage is below {LEAST_COVERAGE:.0%} or a share of "
            f"false differences above {MOST_SPLITS:.0%}.",
        ),
    ] = False,
    as_json: AsJson = False,
) -> None:
    """Count how often intervals contain the true value, and how often ranks are wrong.

    Suites and boards are simulated, with people drawn anew for each; the true values are known.

    Example: colift statistics --repetitions 200
    """
    total = repetitions * (len(SAMPLES) + len(BOARDS) * len(BOARD_SAMPLES))
    with (
        reported_interrupt("shares need all repetitions"),
        job_bar("statistics", total) as bar,
    ):
        covered = [
            each
            for sample in SAMPLES
            for each in coverage(sample, repetitions, seed=seed, progress=bar.advance)
        ]
        splits = [
            false_splits(board, sample, repetitions, seed=seed, progress=bar.advance)
            for sample in BOARD_SAMPLES
            for board in BOARDS
        ]
    holds = all(each.holds for each in covered) and all(each.holds for each in splits)
    if as_json:
        print_json(
            {
                "coverage": [dataclasses.asdict(each) for each in covered],
                "false_splits": [dataclasses.asdict(each) for each in splits],
                "least_coverage": LEAST_COVERAGE,
                "most_splits": MOST_SPLITS,
                "holds": holds,
            }
        )
    else:
        show(_coverage_table(covered), _splits_table(splits))
    if check and not holds:
        raise typer.Exit(1)


def _coverage_table(found: list[Coverage]) -> Table:
    quantities = list(dict.fromkeys(each.quantity for each in found))
    rows: dict[tuple[str, int], dict[str, str]] = {}
    for each in found:
        row = rows.setdefault((each.sample, each.people), {})
        row[each.quantity] = f"{each.share:.1%}"
    return table(
        "95 % intervals that contain the true value",
        (left("people"), "number", *quantities),
        (
            (name, str(people), *(row[quantity] for quantity in quantities))
            for (name, people), row in rows.items()
        ),
        caption=f"Of {found[0].suites} suites, with people drawn anew for each. difference: of a "
        "policy and two people; gap: of hidden and public lifts.",
    )


def _splits_table(found: list[Splits]) -> Table:
    return table(
        "Boards on which equal policies are told apart",
        (left("board"), left("people"), "number", "share"),
        ((each.board, each.sample, str(each.people), f"{each.share:.1%}") for each in found),
        caption=f"Of {found[0].boards} boards, with people drawn anew for each.",
    )
