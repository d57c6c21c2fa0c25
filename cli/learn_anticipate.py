"""``colift learn anticipate``: learn how people move on, from lifts with simulated people."""

from pathlib import Path
from typing import Annotated

import numpy as np
import typer
from rich import box
from rich.console import Console
from rich.table import Table

from ..agents.policies.anticipation import Anticipation, anticipation_json
from ..benchmark.anticipation_experience import Timing
from ..benchmark.anticipation_learning import FIRST_SEED, LIFTS, ROUNDS, learn_anticipation
from ..benchmark.executors import default_jobs, local_pool
from ..benchmark.scenario import CONTROL_PERIOD, LATENCY
from .output import check_output
from .progress import progress_bar


def anticipate(
    lifts: Annotated[int, typer.Option(metavar="N", help="Lifts of a round.")] = LIFTS,
    rounds: Annotated[int, typer.Option(metavar="N", help="Rounds of lifting and fitting.")] = (
        ROUNDS
    ),
    seed: Annotated[int, typer.Option(help="Seed of the first lift.")] = FIRST_SEED,
    latency: Annotated[
        float, typer.Option(metavar="S", help="Age of the robot's data, in seconds.")
    ] = LATENCY,
    control_period: Annotated[
        float, typer.Option(metavar="S", help="Time between two decisions, in seconds.")
    ] = CONTROL_PERIOD,
    out: Annotated[
        Path | None, typer.Option(metavar="FILE.json", help="Where to write what was learned.")
    ] = None,
    jobs: Annotated[
        int | None, typer.Option(metavar="N", help="Worker processes; default: all cores.")
    ] = None,
) -> None:
    """Learn to foresee people, from lifts with new ones in each, in rounds."""
    check_output(out)
    learned: list[Anticipation] = []
    with (
        local_pool(default_jobs() if jobs is None else jobs) as pool,
        progress_bar("lifting", rounds * lifts) as progress,
    ):
        for model in learn_anticipation(
            lifts=lifts,
            rounds=rounds,
            timing=Timing(latency=latency, control_period=control_period),
            first_seed=seed,
            executor=pool,
            progress=progress,
        ):
            learned.append(model)
    console = Console()
    console.print(_table(learned), highlight=False)
    if out is not None:
        out.write_text(anticipation_json(learned[-1]))
        console.print(f"written: {out}", highlight=False, soft_wrap=True)


def _table(learned: list[Anticipation]) -> Table:
    """Return the error of the foreseen height at each lead, after each round."""
    table = Table(
        title="Error of the foreseen height on what it was learned from, rms mm",
        title_justify="left",
        box=box.SIMPLE_HEAD,
    )
    table.add_column("round", justify="right")
    table.add_column("samples", justify="right")
    for lead in learned[-1].leads:
        table.add_column(f"{1000 * np.round(lead, 3):+.0f} ms", justify="right")
    for number, model in enumerate(learned, 1):
        errors = model.provenance["rms_error_mm"]
        samples = str(model.provenance["samples"])
        table.add_row(str(number), samples, *(f"{error:.2f}" for error in errors))
    return table
