"""``colift train``: policies trained from scratch, as submissions."""

from collections.abc import Callable, Iterator
from concurrent.futures import Executor
from contextlib import contextmanager
from pathlib import Path
from typing import Annotated, Any

import typer
from colift.agents.errors import InputError
from colift.agents.registry import SUITES, own_entries
from colift.benchmark.episode.level import LEVEL
from colift.benchmark.execution.pool import local_pool
from colift.benchmark.execution.progress import job_bar
from colift.benchmark.suites.suite import make_suite
from colift.benchmark.tables.printing import show
from colift.benchmark.training import cem as cross_entropy
from colift.benchmark.training.apg_settings import NAME as APG
from colift.benchmark.training.apg_settings import ApgSettings
from colift.benchmark.training.cem import CemSettings
from colift.benchmark.training.course import Course, Point, open_course, write_summary
from colift.benchmark.training.ppo_settings import (
    CO_PLAY,
    SELF_PLAY,
    CoPlaySettings,
    PpoSettings,
    SelfPlaySettings,
)
from colift.benchmark.training.ppo_settings import NAME as PPO
from colift.benchmark.twin.libraries import require_jax
from colift.cli.interrupts import reported_interrupt
from colift.cli.options import Jobs
from colift.cli.remedies import argument
from colift.cli.tables.training import training_table
from typer.core import TyperGroup

MOST_SEEDS = 100

Seeds = Annotated[
    int, typer.Option(metavar="N", help="Number of trainings, with the seeds 0 to N-1.")
]
Out = Annotated[
    Path, typer.Option(metavar="DIR", help="Folder for the policies; the same folder resumes.")
]
Updates = Annotated[
    int, typer.Option(metavar="N", help="Number of updates, each from newly played lifts.")
]
LiftsOfUpdate = Annotated[int, typer.Option(metavar="N", help="Lifts per update.")]
Haste = Annotated[
    float, typer.Option(metavar="X", help="Cost to the person of the distance from the goal.")
]

Train = Callable[[Course, Executor | None, Callable[[int], None]], None]
"""A function that trains a course on an executor and reports progress."""


class _Trainers(TyperGroup):
    """The trainers, as commands."""

    def resolve_command(self, ctx: Any, args: list[str]) -> Any:
        if args[0] not in self.commands:
            raise InputError(f"no trainer {args[0]!r}; trainers: {', '.join(self.commands)}")
        return super().resolve_command(ctx, args)


app = typer.Typer(
    cls=_Trainers,
    help="Train a policy from scratch; the result is a submission.",
    no_args_is_help=True,
)


@app.command()
def cem(
    out: Out,
    seeds: Seeds = 1,
    generations: Annotated[
        int, typer.Option(metavar="N", help="Number of generations.")
    ] = CemSettings.generations,
    population: Annotated[
        int, typer.Option(metavar="N", help="Candidates per generation.")
    ] = CemSettings.population,
    elite: Annotated[
        int, typer.Option(metavar="N", help="Best candidates, on which the next are modelled.")
    ] = CemSettings.elite,
    lifts: Annotated[
        int, typer.Option(metavar="N", help="Lifts per generation.")
    ] = CemSettings.lifts,
    jobs: Jobs = None,
) -> None:
    """Train a small network by the cross-entropy method, in the engine, in minutes, with NumPy."""
    settings = CemSettings(generations=generations, population=population, elite=elite, lifts=lifts)

    def train(course: Course, executor: Executor | None, progress: Callable[[int], None]) -> None:
        cross_entropy.train_cem(settings, course, executor=executor, progress=progress)

    _train_all(cross_entropy.NAME, settings, seeds, out, generations * lifts, jobs, train)


@app.command()
def apg(
    out: Out,
    seeds: Seeds = 1,
    task: Annotated[
        str, typer.Option(metavar="NAME", help="Task: level, or one that is stated by rules.")
    ] = ApgSettings.task,
    updates: Annotated[
        int, typer.Option(metavar="N", help="Steps of the optimiser.")
    ] = ApgSettings.updates,
    lifts: Annotated[
        int, typer.Option(metavar="N", help="Lifts drawn at the beginning.")
    ] = ApgSettings.lifts,
    batch: Annotated[
        int, typer.Option(metavar="N", help="Lifts per update, chosen from those drawn.")
    ] = ApgSettings.batch,
    units: Annotated[
        int, typer.Option(metavar="N", help="Gated recurrent units of the network.")
    ] = ApgSettings.units,
    rate: Annotated[
        float, typer.Option(metavar="X", help="Learning rate at its highest.")
    ] = ApgSettings.rate,
    wide: Annotated[
        float,
        typer.Option(
            metavar="X", help="Share of people from wide ranges; in tasks with touch: their width."
        ),
    ] = ApgSettings.wide,
    varied: Annotated[
        float, typer.Option(metavar="X", help="Variation of the robot's arms in the last update.")
    ] = ApgSettings.varied,
    encoders: Annotated[
        float, typer.Option(metavar="X", help="Noise of the hand's encoders, in m.")
    ] = ApgSettings.encoders,
    smoothness: Annotated[
        float, typer.Option(metavar="X", help="Weight of the cost of bends beside the RMSE.")
    ] = ApgSettings.smoothness,
    gentleness: Annotated[
        float, typer.Option(metavar="X", help="Cost of the force at the human's hands, in mm/N.")
    ] = ApgSettings.gentleness,
) -> None:
    """Train a recurrent network by gradients through whole lifts of the twin (extra: train)."""
    settings = ApgSettings(
        task=task,
        updates=updates,
        lifts=lifts,
        batch=batch,
        units=units,
        rate=rate,
        wide=wide,
        varied=varied,
        encoders=encoders,
        smoothness=smoothness,
        gentleness=gentleness,
    )
    require_jax()
    from colift.benchmark.training.apg_course import train_apg

    def train(course: Course, executor: Executor | None, progress: Callable[[int], None]) -> None:
        train_apg(settings, course, progress)

    _train_all(APG, settings, seeds, out, settings.updates, 1, train)


@app.command()
def ppo(
    out: Out,
    seeds: Seeds = 1,
    updates: Updates = PpoSettings.updates,
    pool: Annotated[
        int, typer.Option(metavar="N", help="Lifts drawn at the beginning.")
    ] = PpoSettings.pool,
    lifts: LiftsOfUpdate = PpoSettings.lifts,
    jobs: Jobs = None,
) -> None:
    """Train a network by proximal policy optimisation, on the twin (extra: train)."""
    settings = PpoSettings(updates=updates, pool=pool, lifts=lifts)
    require_jax()
    from colift.benchmark.training.ppo import train_ppo

    def train(course: Course, executor: Executor | None, progress: Callable[[int], None]) -> None:
        train_ppo(settings, course, executor=executor, progress=progress)

    _train_all(PPO, settings, seeds, out, updates, jobs, train)


@app.command(SELF_PLAY)
def self_play(
    out: Out,
    seeds: Seeds = 1,
    updates: Updates = SelfPlaySettings.updates,
    lifts: LiftsOfUpdate = SelfPlaySettings.lifts,
    haste: Haste = SelfPlaySettings.haste,
    jobs: Jobs = None,
) -> None:
    """Train by PPO with a person who also learns, without colift's behaviours (extra: train)."""
    settings = SelfPlaySettings(updates=updates, lifts=lifts, haste=haste)
    require_jax()
    from colift.benchmark.training.self_play import train_self_play

    def train(course: Course, executor: Executor | None, progress: Callable[[int], None]) -> None:
        train_self_play(settings, course, executor=executor, progress=progress)

    _train_all(SELF_PLAY, settings, seeds, out, updates, jobs, train)


@app.command(CO_PLAY)
def co_play(
    out: Out,
    seeds: Seeds = 1,
    population: Annotated[
        int, typer.Option(metavar="N", help="Trainings by self-play first; each gives 3 people.")
    ] = CoPlaySettings.population,
    updates: Annotated[
        int, typer.Option(metavar="N", help="Updates per training, the last one included.")
    ] = CoPlaySettings.updates,
    lifts: LiftsOfUpdate = CoPlaySettings.lifts,
    haste: Haste = CoPlaySettings.haste,
    jobs: Jobs = None,
) -> None:
    """Train with a population of people who learned by self-play (extra: train)."""
    settings = CoPlaySettings(population=population, updates=updates, lifts=lifts, haste=haste)
    require_jax()
    from colift.benchmark.training.co_play import train_co_play

    def train(course: Course, executor: Executor | None, progress: Callable[[int], None]) -> None:
        train_co_play(settings, course, executor=executor, progress=progress)

    _train_all(CO_PLAY, settings, seeds, out, (population + 1) * updates, jobs, train)


def _train_all(
    trainer: str, settings: Any, seeds: int, out: Path, total: int, jobs: int | None, train: Train
) -> None:
    """Train all seeds and print their table; finished ones are not trained again."""
    if not 1 <= seeds <= MOST_SEEDS:
        raise InputError(f"--seeds must be 1 to {MOST_SEEDS}, got {seeds}")
    courses = []
    resumable = reported_interrupt(f"{out} has the checkpoints; the same command resumes")
    with resumable, local_pool(jobs) as pool:
        for seed in range(seeds):
            with _shown(seed, total) as (report, progress):
                course = open_course(out, trainer, settings, seed, report)
                if not (course.policy.exists() and course.load()):
                    train(course, pool, progress)
                courses.append(course)
    show(training_table(trainer, courses))
    print(f"written: {write_summary(courses)}")
    best = min(courses, key=lambda course: course.curve[-1].rmse_mm).policy
    on = _suite_option(getattr(settings, "task", LEVEL.name))
    print(f"Next: colift run {argument(best)}{on}, or colift check {argument(best)}{on}")


def _suite_option(task: str) -> str:
    """Return the option that names the first suite of a task; empty for ``level``."""
    if task == LEVEL.name:
        return ""
    suites = (make_suite(name) for name in own_entries(SUITES))
    return f" --suite {next(s.name for s in suites if s.scenarios[0].task.name == task)}"


@contextmanager
def _shown(
    seed: int, total: int
) -> Iterator[tuple[Callable[[Point], None], Callable[[int], None]]]:
    """Show the progress of a training; yield the callbacks for points of its curve and progress."""
    with job_bar(f"seed {seed}", total) as bar:

        def report(point: Point) -> None:
            bar.stage(f"seed {seed}: {point.rmse_mm:.2f} mm")

        yield report, bar.advance
