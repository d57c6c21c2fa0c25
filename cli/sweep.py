"""``colift sweep``: what a faster or better-informed robot would gain."""

from pathlib import Path
from typing import Annotated

import typer
from rich.table import Table

from ..agents.errors import InputError
from ..benchmark.bounds import sweep as sweeping
from ..benchmark.bounds.held_out import held_out_suite
from ..benchmark.bounds.sweep import NAMES, Swept, lifts_to_play, team_rmse, timings
from ..benchmark.execution.pool import local_pool
from .options import Jobs, check_output
from .printing import show, table
from .progress import progress_bar


def sweep_rates(
    lifts: Annotated[
        int, typer.Option(metavar="N", help="Lifts of a round of learning.", min=1)
    ] = 400,
    people: Annotated[int, typer.Option(metavar="N", help="New people to lift with.", min=1)] = 8,
    each: Annotated[
        int, typer.Option(metavar="N", help="Lifts with each, in each way to move.", min=1)
    ] = 2,
    out: Annotated[
        Path | None,
        typer.Option(metavar="FILE.png", help="Where to draw it; numbers go beside, as .json."),
    ] = None,
    jobs: Jobs = None,
) -> None:
    """Sweep latency and control period: the paper's policies, anticipate, and the bounds."""
    if out is not None and out.suffix != ".png":
        raise InputError(f"--out must end in .png, got {out}")
    check_output(out)
    suite = held_out_suite(people, each)
    with (
        local_pool(jobs) as pool,
        progress_bar("sweep", lifts_to_play(suite, lifts)) as progress,
    ):
        team = team_rmse(suite, executor=pool, progress=progress)
        swept = list(sweeping.sweep(suite, lifts=lifts, executor=pool, progress=progress))
    show(_table(swept, team, suite.name))
    if out is not None:
        # matplotlib is slow to load.
        from ..benchmark.bounds.sweep_picture import sweep_figure, sweep_json

        sweep_figure(swept, team, "What a fresher or a faster robot gains").savefig(out)
        out.with_suffix(".json").write_text(sweep_json(swept, team))
        print(f"written: {out}")


def _table(swept: list[Swept], team: float, suite: str) -> Table:
    rows = []
    for timing in timings():
        latency, period = timing.latency, timing.control_period
        found = {
            each.policy: each.rmse_mm
            for each in swept
            if (each.latency, each.control_period) == (latency, period)
        }
        row = (f"{1000 * latency:.0f}", f"{1000 * period:.0f}")
        rows.append((*row, *(f"{found[name]:.2f}" for name in NAMES)))
    return table(
        f"RMSE mm on {suite}",
        ("latency ms", "period ms", *NAMES),
        rows,
        caption=f"human-human team: {team:.2f} mm",
    )
