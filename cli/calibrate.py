"""``colift calibrate``: fit of the simulated world's free parameters to the paper's results."""

from pathlib import Path
from typing import Annotated

import typer
from colift.benchmark.execution.progress import workers
from colift.benchmark.paper.calibration import (
    ROUNDS,
    TABLE_1,
    Fit,
    calibration_json,
    episodes,
    fit_rounds,
)
from colift.benchmark.tables.printing import show, table
from colift.cli.options import Jobs, check_new_file, write_output
from rich.table import Table


def calibrate(
    out: Annotated[
        Path | None,
        typer.Option(metavar="FILE", help="File for the parameters, with their provenance."),
    ] = None,
    jobs: Jobs = None,
) -> None:
    """Fit lift heights, process noise and the human partner's lag to the paper's results.

    Example: colift calibrate --out calibration.json
    """
    check_new_file(out)
    with workers("calibrating", episodes(), jobs) as (pool, progress):
        for number, fit in enumerate(fit_rounds(executor=pool, progress=progress), 1):
            print(
                f"round {number} of {ROUNDS}: worst cell {100 * fit.worst_cell:.1f} % off, "
                f"two people {fit.human_human:.3f} mm"
            )
    show(_table(fit))
    write_output(out, calibration_json(fit))


def _table(fit: Fit) -> Table:
    numbers = fit.calibration
    return table(
        "Table I (mm), measured and the paper's",
        ("subject", "height mm", "without", "paper", "with", "paper"),
        (
            (
                name,
                f"{1000 * numbers.amplitude[name]:.1f}",
                f"{fit.without[name]:.2f}",
                f"{row[0]:.2f}",
                f"{fit.with_prediction[name]:.2f}",
                f"{row[1]:.2f}",
            )
            for name, row in TABLE_1.items()
        ),
        caption=f"process noise q = {numbers.process_noise:.3g} mm2/s6, "
        f"partner's lag {1000 * numbers.partner_lag:.1f} ms",
    )
