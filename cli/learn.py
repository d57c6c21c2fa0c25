"""``colift learn``: learning of policies in the simulated world."""

import dataclasses
from pathlib import Path
from typing import Annotated, Any

import typer
from colift.agents.control.anticipation import Anticipation, anticipation_json
from colift.agents.control.learned_task import task_json
from colift.agents.control.linear_forecast import linear_json
from colift.base.errors import InputError
from colift.benchmark.episode.scenario import CONTROL_PERIOD, LATENCY
from colift.benchmark.execution.pool import checked_jobs
from colift.benchmark.execution.progress import progress_bar, workers
from colift.benchmark.tables.printing import show
from colift.benchmark.training import anticipation
from colift.benchmark.training import linear as linear_training
from colift.benchmark.training.data import Timing
from colift.benchmark.training.demonstrations import FIRST_SEED, LIFTS, read_demonstrations
from colift.benchmark.training.q_learning import LearningTrial, learning_trials, table_json
from colift.benchmark.training.scikit import import_sklearn
from colift.benchmark.training.task_model import (
    COMPONENTS,
    TUNING_LIFTS,
    fine_tune,
    learn_task,
)
from colift.cli.demonstrate import record
from colift.cli.options import LATENCY_OPTION, PERIOD_OPTION, Jobs, check_new_file, write_output
from colift.cli.tables.learning import (
    anticipation_table,
    convergence_text,
    linear_table,
    q_table,
    task_table,
)
from typer.core import TyperGroup

Lifts = Annotated[int, typer.Option(metavar="N", help="Lifts per round.")]
Rounds = Annotated[int, typer.Option(metavar="N", help="Rounds of lifting and fitting.")]
Seed = Annotated[int, typer.Option(metavar="N", help="Seed of the first lift.")]
Out = Annotated[
    Path | None, typer.Option(metavar="FILE.json", help="File for the learned numbers.")
]


class _Learnable(TyperGroup):
    """The learnable policies, as commands."""

    def resolve_command(self, ctx: Any, args: list[str]) -> Any:
        if args[0] not in self.commands:
            raise InputError(f"cannot learn {args[0]!r}; can learn: {', '.join(self.commands)}")
        return super().resolve_command(ctx, args)


app = typer.Typer(
    cls=_Learnable,
    help="Retrain a built-in policy.",
    no_args_is_help=True,
)


@app.command()
def reactive(
    trials: Annotated[
        int, typer.Option(metavar="N", help="Independent learning trials; the first is shown.")
    ] = 1,
    seed: Annotated[int, typer.Option(metavar="N", help="Seed of the first trial.")] = 0,
    out: Annotated[
        Path | None, typer.Option(metavar="FILE", help="File for the first trial's table.")
    ] = None,
    jobs: Jobs = None,
) -> None:
    """Learn the paper's reactive controller online, while the human stands still.

    Example: colift learn reactive --trials 20
    """
    if trials < 1:
        raise InputError(f"--trials must be at least 1, got {trials}")
    check_new_file(out)
    done: list[LearningTrial] = []
    jobs = min(trials, checked_jobs(jobs))
    with workers("learning", trials, jobs) as (pool, progress):
        for trial in learning_trials(trials, seed, executor=pool):
            done.append(trial)
            progress(1)
    show(q_table(done[0]))
    print(convergence_text(done))
    write_output(out, table_json(done[0], seed))


@app.command("task_model")
def task_model(
    demonstrations: Annotated[
        Path | None,
        typer.Option(
            metavar="FILE.csv", help="Lifts of 'colift demonstrate'; default: record new ones."
        ),
    ] = None,
    components: Annotated[
        int, typer.Option(metavar="N", help="Gaussians of the mixture.")
    ] = COMPONENTS,
    seed: Annotated[int, typer.Option(metavar="N", help="Seed of the mixture's fit.")] = 0,
    practice: Annotated[
        int, typer.Option(metavar="N", help="Lifts in which the impedance is learned.")
    ] = TUNING_LIFTS,
    out: Annotated[
        Path | None, typer.Option(metavar="FILE.json", help="File for the model.")
    ] = None,
) -> None:
    """Learn the task model from demonstrations, then its impedance by practice.

    Example: colift learn task_model --out task_model.json
    """
    if practice < 1:
        raise InputError(f"--practice must be at least 1, got {practice}")
    check_new_file(out)
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
    show(task_table(task))
    write_output(out, task_json(task))


@app.command()
def anticipate(
    lifts: Lifts = anticipation.LIFTS,
    rounds: Rounds = anticipation.ROUNDS,
    seed: Seed = anticipation.FIRST_SEED,
    latency: Annotated[float, LATENCY_OPTION] = LATENCY,
    control_period: Annotated[float, PERIOD_OPTION] = CONTROL_PERIOD,
    out: Out = None,
    jobs: Jobs = None,
) -> None:
    """Learn to predict the human's motion, in rounds of lifts with drawn subjects.

    Example: colift learn anticipate --out anticipate.json
    """
    timing = Timing(latency=latency, control_period=control_period)
    command = f"colift learn anticipate --lifts {lifts} --rounds {rounds} --seed {seed}"
    if timing != Timing():
        command += f" --latency {latency:g} --control-period {control_period:g}"
    check_new_file(out)
    models: list[Anticipation] = []
    with workers("lifting", rounds * lifts, jobs) as (pool, progress):
        for lesson in anticipation.learn_anticipation(
            lifts=lifts,
            rounds=rounds,
            timing=timing,
            first_seed=seed,
            executor=pool,
            progress=progress,
        ):
            models.append(lesson.model)
    show(anticipation_table(models))
    provenance = {"command": command, **models[-1].provenance}
    write_output(out, anticipation_json(dataclasses.replace(models[-1], provenance=provenance)))


@app.command()
def linear(
    lifts: Annotated[
        int, typer.Option(metavar="N", help="Lifts to learn from.")
    ] = linear_training.LIFTS,
    seed: Seed = anticipation.FIRST_SEED,
    out: Out = None,
) -> None:
    """Learn to predict the human's motion by a linear function of ten samples.

    Example: colift learn linear --out linear.json
    """
    check_new_file(out)
    with progress_bar("lifting", lifts) as progress:
        forecast = linear_training.learn_linear(lifts=lifts, first_seed=seed, progress=progress)
    show(linear_table(forecast))
    command = f"colift learn linear --lifts {lifts} --seed {seed}"
    provenance = {"command": command, **forecast.provenance}
    write_output(out, linear_json(dataclasses.replace(forecast, provenance=provenance)))
