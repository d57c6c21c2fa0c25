"""``colift ablate``: what each part of `anticipate` is worth."""

from pathlib import Path
from typing import Annotated

import typer
from rich.table import Table

from ..benchmark.bounds import ablation
from ..benchmark.bounds.ablation import VARIANTS, Ablation, variants
from ..benchmark.bounds.held_out import held_out_suite
from ..benchmark.execution.pool import local_pool
from ..benchmark.statistics import Estimate
from ..benchmark.suites.suite import recorded_suite
from ..benchmark.training.anticipation import LIFTS, ROUNDS, learn_anticipation
from .options import Jobs
from .printing import show, table
from .progress import progress_bar


def ablate_policies(
    lifts: Annotated[int, typer.Option(metavar="N", help="Lifts of a round of learning.")] = LIFTS,
    people: Annotated[int, typer.Option(metavar="N", help="New people to lift with.")] = 20,
    each: Annotated[
        int, typer.Option(metavar="N", help="Lifts with each, in each way to move.")
    ] = 3,
    recordings: Annotated[
        Path | None,
        typer.Option(metavar="CSV", help="Recorded lifts (trial,t_s,z_m) instead of new people."),
    ] = None,
    jobs: Jobs = None,
) -> None:
    """Take anticipate apart: learn it without each of its parts, and lift with new people."""
    suite = held_out_suite(people, each) if recordings is None else recorded_suite(recordings)
    total = ROUNDS * lifts + (1 + len(VARIANTS)) * suite.size
    with (
        local_pool(jobs) as pool,
        progress_bar("ablation", total) as progress,
    ):
        first, *_, last = learn_anticipation(lifts=lifts, executor=pool, progress=progress)
        found = ablation.ablate(variants(first, last), suite, executor=pool, progress=progress)
    show(_table(found, suite.name))


def _table(found: list[Ablation], suite: str) -> Table:
    return table(
        f"Without each part, on {suite}",
        ("without", "RMSE", "more", "SPARC", "rougher by"),
        (
            (
                each.name,
                f"{each.rmse_mm:.2f}",
                _told(each.worse_mm),
                f"{each.sparc:.3f}",
                _told(each.rougher, 3),
            )
            for each in found
        ),
        caption="RMSE in mm, SPARC (closer to 0 is smoother); in brackets the 95 % interval of the "
        "paired difference to the whole.",
    )


def _told(difference: Estimate | None, digits: int = 2) -> str:
    if difference is None:
        return ""
    low, high = difference.ci95
    return f"{difference.mean:+.{digits}f} ({low:+.{digits}f} to {high:+.{digits}f})"
