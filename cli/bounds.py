"""``colift bounds``: whether `anticipate` keeps what is claimed of it, on people it never met."""

from pathlib import Path
from typing import Annotated

import typer
from rich.table import Table

from ..agents.loading.loading import PolicySpec
from ..benchmark.bounds.causal import BOUNDS
from ..benchmark.bounds.claims import POLICY, RIVALS, PolicyClaim, claims
from ..benchmark.bounds.held_out import FIRST_SEED, held_out_suite
from ..benchmark.comparison.comparison import compare
from ..benchmark.comparison.contest import amount, play_contest
from ..benchmark.execution.pool import local_pool
from ..benchmark.suites.suite import recorded_suite
from .options import Jobs
from .printing import show, table
from .progress import progress_bar
from .tables.comparison import behaviours_table, ranks_table


def bounds(
    people: Annotated[int, typer.Option(metavar="N", help="New people to lift with.")] = 20,
    each: Annotated[
        int, typer.Option(metavar="N", help="Lifts with each, in each way to move.")
    ] = 5,
    seed: Annotated[int, typer.Option(help="Seed of the first of them.")] = FIRST_SEED,
    recordings: Annotated[
        Path | None,
        typer.Option(metavar="CSV", help="Recorded lifts (trial,t_s,z_m) instead."),
    ] = None,
    jobs: Jobs = None,
) -> None:
    """Measure anticipate against people, the paper's policies and the bounds, with new people."""
    suite = held_out_suite(people, each, seed) if recordings is None else recorded_suite(recordings)
    specs = {name: PolicySpec(text=name) for name in (POLICY, *RIVALS)}
    total = amount(len(specs), suite, bounds=len(BOUNDS))
    with (
        local_pool(jobs) as pool,
        progress_bar("bounds", total) as progress,
    ):
        contest = play_contest(specs, suite, bounds=BOUNDS, executor=pool, progress=progress)
    comparison = compare(contest)
    show(ranks_table(comparison))
    if recordings is None:
        show(behaviours_table(comparison))
    found = claims(contest)
    show(_table(found))
    if not all(claim.holds for claim in found):
        raise typer.Exit(1)


def _table(found: tuple[PolicyClaim, ...]) -> Table:
    return table(
        f"Claims of {POLICY}",
        ("what", "value", "95 %", "limit", "holds"),
        (
            (
                claim.text,
                f"{claim.value:.3f}",
                "" if claim.ci95 is None else f"{claim.ci95[0]:.3f} to {claim.ci95[1]:.3f}",
                f"{'at least' if claim.least else 'at most'} {claim.limit:g}",
                "yes" if claim.holds else "NO",
            )
            for claim in found
        ),
    )
