"""Trained policies as a table for a terminal."""

from collections.abc import Sequence

import numpy as np
from colift.benchmark.tables.printing import Cell, table
from colift.benchmark.training.course import Course
from rich.table import Table


def training_table(trainer: str, courses: Sequence[Course]) -> Table:
    """Return a row per seed, and the mean of all."""
    rows: list[Sequence[Cell] | None] = [
        (str(each.seed), f"{each.steps:,}", f"{each.curve[-1].rmse_mm:.2f}") for each in courses
    ]
    errors = [each.curve[-1].rmse_mm for each in courses]
    if len(errors) > 1:
        spread = f"{np.mean(errors):.2f} ± {np.std(errors, ddof=1):.2f}"
        rows += [None, ("mean ± SD", "", spread)]
    return table(
        f"Trained by {trainer}: validation lifts",
        ("seed", "steps", "RMSE mm"),
        rows,
        caption="Scores come from a suite: colift run.",
    )
