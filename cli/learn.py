"""``colift learn``: learn a policy in the world."""

import dataclasses
from pathlib import Path
from typing import Annotated, Any

import numpy as np
import typer
from rich.table import Table
from rich.text import Text
from typer.core import TyperGroup

from ..agents.control.learned_task import LearnedTask, task_json
from ..agents.control.q_learning import ACTIONS, Q_PARAMETERS
from ..agents.errors import InputError
from ..benchmark.execution.pool import checked_jobs, local_pool
from ..benchmark.training.demonstrations import FIRST_SEED, LIFTS, read_demonstrations
from ..benchmark.training.q_learning import LearningTrial, learning_trials, table_json
from ..benchmark.training.scikit import import_sklearn
from ..benchmark.training.task_model import (
    COMPONENTS,
    TUNING_LIFTS,
    fine_tune,
    learn_task,
)
from .demonstrate import record
from .learn_anticipate import anticipate, learn_causal_bound
from .options import Jobs, check_output, write_output
from .printing import Cell, show, table
from .progress import progress_bar


class _Learnable(TyperGroup):
    """The policies that can be learned, as commands."""

    def resolve_command(self, ctx: Any, args: list[str]) -> Any:
        if args[0] not in self.commands:
            raise InputError(f"cannot learn {args[0]!r}; can learn: {', '.join(self.commands)}")
        return super().resolve_command(ctx, args)


app = typer.Typer(
    cls=_Learnable,
    help="Learn a policy in the world, as the shipped one was learned.",
    no_args_is_help=True,
)


@app.command()
def reactive(
    trials: Annotated[
        int, typer.Option(metavar="N", help="Independent learning trials; the first is shown.")
    ] = 1,
    seed: Annotated[int, typer.Option(help="Seed of the first trial.")] = 0,
    out: Annotated[
        Path | None, typer.Option(metavar="FILE", help="Where to write the first trial's table.")
    ] = None,
    jobs: Jobs = None,
) -> None:
    """Learn the paper's reactive controller online, while the human stands still."""
    if trials < 1:
        raise InputError(f"--trials must be at least 1, got {trials}")
    check_output(out)
    done: list[LearningTrial] = []
    jobs = min(trials, checked_jobs(jobs))
    with local_pool(jobs) as pool, progress_bar("learning", trials) as progress:
        for trial in learning_trials(trials, seed, executor=pool):
            done.append(trial)
            progress(1)
    show(_table(done[0]))
    print(_convergence(done))
    write_output(out, table_json(done[0], seed))


@app.command("task_model")
def task_model(
    demonstrations: Annotated[
        Path | None,
        typer.Option(metavar="FILE.csv", help="Lifts of 'colift demonstrate'; default: record."),
    ] = None,
    components: Annotated[
        int, typer.Option(metavar="N", help="Gaussians of the mixture.")
    ] = COMPONENTS,
    seed: Annotated[int, typer.Option(help="Seed of the mixture's fit.")] = 0,
    practice: Annotated[
        int, typer.Option(metavar="N", help="Lifts to practise the impedance in.")
    ] = TUNING_LIFTS,
    out: Annotated[
        Path | None, typer.Option(metavar="FILE.json", help="Where to write the model.")
    ] = None,
) -> None:
    """Learn the task model from demonstrations, then its impedance by practice."""
    if practice < 1:
        raise InputError(f"--practice must be at least 1, got {practice}")
    check_output(out)
    import_sklearn("mixture")
    if demonstrations is None:
        lifts = record(LIFTS, FIRST_SEED, None)
    else:
        lifts = list(read_demonstrations(demonstrations))
    task = learn_task(lifts, components=components, seed=seed)
    with progress_bar("practising", practice) as progress:
        task = fine_tune(task, practice, progress=progress)
    source = "" if demonstrations is None else f" --demonstrations {demonstrations.name}"
    command = (
        f"colift learn task_model{source} --components {components} --seed {seed} "
        f"--practice {practice}"
    )
    task = dataclasses.replace(task, provenance={"command": command, **task.provenance})
    show(_task(task))
    write_output(out, task_json(task))


app.command()(anticipate)
app.command("causal_bound")(learn_causal_bound)


def _task(task: LearnedTask) -> Table:
    """Return the situations that the model tells apart, the most frequent first."""
    impedance = task.impedance
    mixture = task.mixture
    rows = []
    for i in np.argsort(-mixture.weights, kind="stable"):
        height, *velocities = 1000 * mixture.means[i]
        speeds = (f"{velocities[0]:.0f}", f"{velocities[-1]:.0f}")
        share = f"{100 * mixture.weights[i]:.0f} %"
        rows.append((share, f"{height:.0f}", *speeds, f"{impedance.stiffness[i]:.2f}"))
    return table(
        "Situations (mean of each component of the mixture) and their stiffness",
        ("share", "height mm", "velocity mm/s", "then", "stiffness"),
        rows,
        caption=f"lead {1000 * impedance.lead:.0f} ms, offset {1000 * impedance.offset:.1f} mm, "
        f"tolerance {1000 * task.tolerance:.1f} mm",
    )


def _table(trial: LearningTrial) -> Table:
    steps = (1000 * action * Q_PARAMETERS.position_step for action in ACTIONS)
    edges = ["", *(f"{1000 * edge:+.0f}" for edge in Q_PARAMETERS.edges), ""]
    rows: list[tuple[Cell, ...]] = []
    for low, high, row in zip(edges, edges[1:], trial.table, strict=False):
        best = int(np.argmax(row))
        name = f"{low} to {high} mm" if low and high else f"above {low}" if low else f"below {high}"
        cells = (
            Text(f"{1000 * value:.1f}", "bold" if i == best else "") for i, value in enumerate(row)
        )
        rows.append((name, *cells))
    return table(
        "Q-table (mm of tilt taken away); the greedy action is bold",
        ("human - robot", *(f"{step:+.0f} mm" for step in steps)),
        rows,
    )


def _convergence(trials: list[LearningTrial]) -> str:
    found = [trial.converged_at for trial in trials if trial.converged_at is not None]
    if len(trials) == 1:
        when = found[0] if found else None
        return f"converged after {when} iterations" if when else "did not converge"
    missed = len(trials) - len(found)
    counts = [*found, *[10**9] * missed]
    median, ninetieth = np.percentile(counts, [50, 90])
    return (
        f"{len(trials)} trials: median {median:.0f} iterations to converge, "
        f"90th percentile {ninetieth:.0f}, {missed} did not converge (paper: median 36)"
    )
