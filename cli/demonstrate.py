"""``colift demonstrate``: recordings of human-human lifts, to learn from."""

from pathlib import Path
from typing import Annotated

import numpy as np
import typer
from colift.benchmark.execution.progress import workers
from colift.benchmark.tables.printing import counted
from colift.benchmark.training.demonstrations import (
    FIRST_SEED,
    LIFTS,
    Demonstration,
    demonstrations,
    write_demonstrations,
)
from colift.cli.interrupts import reported_interrupt
from colift.cli.options import Jobs, check_new_file


def demonstrate_lifts(
    out: Annotated[Path, typer.Option(metavar="FILE.csv", help="File for the lifts.")],
    lifts: Annotated[int, typer.Option(metavar="N", help="Number of lifts.")] = LIFTS,
    seed: Annotated[int, typer.Option(metavar="N", help="Seed of the first lift.")] = FIRST_SEED,
    jobs: Jobs = None,
) -> None:
    """Record lifts of two simulated people: drawn subjects, all behaviours, seeds in no suite.

    Example: colift demonstrate --lifts 40 --out demonstrations.csv
    """
    check_new_file(out)
    with reported_interrupt(f"{out} is not written"):
        recorded = record(lifts, seed, jobs)
    write_demonstrations(out, recorded)
    apart = np.concatenate([each["human_m"] - each["partner_m"] for each in recorded])
    print(
        f"{counted(lifts, 'lift')}, {counted(len(apart), 'sample')}; the ends were "
        f"{1000 * float(np.sqrt(np.mean(apart**2))):.1f} mm apart (rms)\nwritten: {out}"
    )


def record(lifts: int, seed: int, jobs: int | None) -> list[Demonstration]:
    """Return demonstrations, recorded with a progress bar."""
    with workers("demonstrating", lifts, jobs) as (pool, progress):
        recorded = []
        for each in demonstrations(lifts, seed, executor=pool):
            recorded.append(each)
            progress(1)
    return recorded
