"""``colift learn``: learn a controller in the world."""

from pathlib import Path
from typing import Annotated, Final

import numpy as np
import typer
from rich import box
from rich.console import Console
from rich.table import Table

from ..agents.errors import InputError
from ..agents.policies.q_learning import ACTIONS, Q_PARAMETERS
from ..benchmark.learning import LearningTrial, learning_trials, table_json
from .output import check_output
from .pool import default_jobs, local_pool
from .progress import progress_bar

LEARNABLE: Final = ("reactive",)


def learn(
    policy: Annotated[str, typer.Argument(help="What to learn: reactive.")],
    trials: Annotated[
        int, typer.Option(metavar="N", help="Independent learning trials; the first is shown.")
    ] = 1,
    seed: Annotated[int, typer.Option(help="Seed of the first trial.")] = 0,
    out: Annotated[
        Path | None, typer.Option(metavar="FILE", help="Where to write the first trial's table.")
    ] = None,
    jobs: Annotated[
        int | None, typer.Option(metavar="N", help="Worker processes; default: all cores.")
    ] = None,
) -> None:
    """Learn the paper's reactive controller online, while the human stands still."""
    if policy not in LEARNABLE:
        raise InputError(f"cannot learn {policy!r}; can learn: {', '.join(LEARNABLE)}")
    if trials < 1:
        raise InputError(f"--trials must be at least 1, got {trials}")
    check_output(out)
    done: list[LearningTrial] = []
    jobs = min(trials, default_jobs() if jobs is None else jobs)
    with local_pool(jobs) as pool, progress_bar("learning", trials) as progress:
        for trial in learning_trials(trials, seed, executor=pool):
            done.append(trial)
            progress(1)
    console = Console()
    console.print(_table(done[0]))
    console.print(_convergence(done), highlight=False)
    if out is not None:
        out.write_text(table_json(done[0], seed))
        console.print(f"written: {out}", highlight=False, soft_wrap=True)


def _table(trial: LearningTrial) -> Table:
    table = Table(
        title="Q-table (mm of tilt taken away); the greedy action is bold",
        title_justify="left",
        box=box.SIMPLE_HEAD,
    )
    table.add_column("human - robot")
    for action in ACTIONS:
        step = 1000 * action * Q_PARAMETERS.position_step
        table.add_column(f"{step:+.0f} mm", justify="right")
    edges = ["", *(f"{1000 * edge:+.0f}" for edge in Q_PARAMETERS.edges), ""]
    for low, high, row in zip(edges, edges[1:], trial.table, strict=False):
        best = int(np.argmax(row))
        cells = [f"{1000 * value:.1f}" for value in row]
        cells[best] = f"[bold]{cells[best]}[/]"
        name = f"{low} to {high} mm" if low and high else f"above {low}" if low else f"below {high}"
        table.add_row(name, *cells)
    return table


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
