"""``colift references``: play what results are set against."""

from pathlib import Path
from typing import Annotated

import typer

from ..benchmark.bounds.causal import BOUNDS
from ..benchmark.comparison.contest import play_bounds
from ..benchmark.execution.pool import local_pool
from ..benchmark.results.baselines import SPECS, Reference, ToShip, play_references, references_json
from ..benchmark.statistics import stratified_bootstrap
from ..benchmark.suites.suite import SUITES, make_suite
from .options import Jobs, check_output, write_output
from .printing import left, show, table
from .progress import progress_bar


def references(
    out: Annotated[
        Path | None, typer.Option(metavar="FILE", help="Where to write them, to be shipped.")
    ] = None,
    jobs: Jobs = None,
) -> None:
    """Play two people, hold, copy and the bounds on every suite; print the errors by behaviour."""
    check_output(out)
    suites = [make_suite(name) for name in SUITES]
    total = (len(SPECS) + len(BOUNDS)) * sum(suite.size for suite in suites)
    played: list[ToShip] = []
    with (
        local_pool(jobs) as pool,
        progress_bar("references", total) as progress,
    ):
        for suite in suites:
            references = play_references(suite, executor=pool, progress=progress)
            bounds = play_bounds(BOUNDS, suite, executor=pool, progress=progress)
            played.append(ToShip(suite=suite, references=references, bounds=bounds))
    rows = [
        (each.suite.name, name, behaviour, *_error(reference, behaviour))
        for each in played
        for name, reference in {**each.references, **each.bounds}.items()
        for behaviour in (*dict.fromkeys(key[0] for key in reference.cells), "all")
    ]
    titles = ("suite", left("reference"), left("human"), "RMSE mm", "95 % interval")
    show(table("", titles, rows))
    write_output(out, references_json(played))


def _error(reference: Reference, behaviour: str) -> tuple[str, str]:
    """Return mean and interval over the episodes of a behaviour, or over all."""
    chosen = [
        (cell, value)
        for cell, value in zip(reference.cells, reference.rmse_mm, strict=True)
        if behaviour in ("all", cell[0])
    ]
    values = [value for _, value in chosen]
    low, high = stratified_bootstrap(values, [cell for cell, _ in chosen])
    return f"{sum(values) / len(values):.2f}", f"{low:.2f} to {high:.2f}"
