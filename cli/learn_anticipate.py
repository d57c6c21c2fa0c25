"""``colift learn anticipate`` and ``causal_bound``: learn how people move on, from lifts."""

import dataclasses
from collections.abc import Sequence
from pathlib import Path
from typing import Annotated, Final

import numpy as np
import typer
from rich.table import Table

from ..agents.control.anticipation import Anticipation, anticipation_json, load_anticipation
from ..benchmark.bounds import causal
from ..benchmark.episode.scenario import CONTROL_PERIOD, LATENCY
from ..benchmark.execution.pool import local_pool
from ..benchmark.training.anticipation import FIRST_SEED, HIDDEN, LIFTS, ROUNDS, learn_anticipation
from ..benchmark.training.data import Timing
from .options import Jobs, check_output, write_output
from .printing import show, table
from .progress import progress_bar

SHOWN: Final = 2
"""Every second lead is shown, so that the table fits a terminal."""

Lifts = Annotated[int, typer.Option(metavar="N", help="Lifts of a round.")]
Rounds = Annotated[int, typer.Option(metavar="N", help="Rounds of lifting and fitting.")]
Seed = Annotated[int, typer.Option(help="Seed of the first lift.")]
Out = Annotated[
    Path | None, typer.Option(metavar="FILE.json", help="Where to write what was learned.")
]


def anticipate(
    lifts: Lifts = LIFTS,
    rounds: Rounds = ROUNDS,
    seed: Seed = FIRST_SEED,
    latency: Annotated[
        float, typer.Option(metavar="S", help="Age of the robot's data, in seconds.")
    ] = LATENCY,
    control_period: Annotated[
        float, typer.Option(metavar="S", help="Time between two decisions, in seconds.")
    ] = CONTROL_PERIOD,
    out: Out = None,
    jobs: Jobs = None,
) -> None:
    """Learn to foresee people, from lifts with new ones in each, in rounds."""
    timing = Timing(latency=latency, control_period=control_period)
    command = f"colift learn anticipate --lifts {lifts} --rounds {rounds} --seed {seed}"
    if timing != Timing():
        command += f" --latency {latency:g} --control-period {control_period:g}"
    _learn(command, lifts, rounds, seed, HIDDEN, timing, out, jobs)


def learn_causal_bound(
    lifts: Annotated[int, typer.Option(metavar="N", help="Lifts.")] = causal.LIFTS,
    seed: Seed = causal.FIRST_SEED,
    out: Out = None,
    jobs: Jobs = None,
) -> None:
    """Learn the causal bound: as anticipate, but larger, and from other lifts and people."""
    command = f"colift learn causal_bound --lifts {lifts} --seed {seed}"
    _learn(command, lifts, 1, seed, causal.HIDDEN, Timing(), out, jobs, load_anticipation())


def _learn(
    command: str,
    lifts: int,
    rounds: int,
    seed: int,
    hidden: Sequence[int],
    timing: Timing,
    out: Path | None,
    jobs: int | None,
    partner: Anticipation | None = None,
) -> None:
    check_output(out)
    models: list[Anticipation] = []
    with (
        local_pool(jobs) as pool,
        progress_bar("lifting", rounds * lifts) as progress,
    ):
        for lesson in learn_anticipation(
            lifts=lifts,
            rounds=rounds,
            hidden=hidden,
            timing=timing,
            first_seed=seed,
            partner=partner,
            executor=pool,
            progress=progress,
        ):
            models.append(lesson.model)
    show(_table(models))
    provenance = {"command": command, **models[-1].provenance}
    write_output(out, anticipation_json(dataclasses.replace(models[-1], provenance=provenance)))


def _table(models: list[Anticipation]) -> Table:
    """Return the error of the foreseen height at each lead, after each round."""
    leads = models[-1].leads[::SHOWN]
    return table(
        "Error of the foreseen height on what it was learned from, rms mm",
        ("round", "samples", *(f"{1000 * np.round(lead, 3):+.0f} ms" for lead in leads)),
        (
            (
                str(number),
                str(model.provenance["samples"]),
                *(f"{error:.2f}" for error in model.provenance["rms_error_mm"][::SHOWN]),
            )
            for number, model in enumerate(models, 1)
        ),
    )
