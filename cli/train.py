"""``colift train``: policies trained from scratch, as submissions."""

from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager, suppress
from importlib import import_module
from pathlib import Path
from typing import Annotated, Any

import typer
from colift.base.errors import InputError
from colift.base.registry import STANDARD_SUITE, SUITES, entries, own_entries
from colift.benchmark.execution.pool import local_pool
from colift.benchmark.execution.progress import job_bar
from colift.benchmark.rendering.layout import PAGE, Layout
from colift.benchmark.suites.suite import make_suite
from colift.benchmark.tables.printing import show
from colift.benchmark.tasks.level.task import LEVEL
from colift.benchmark.training import apg_settings, cem
from colift.benchmark.training.apg_settings import ApgSettings
from colift.benchmark.training.course import Point, open_course, write_summary
from colift.benchmark.training.session_kinds import SESSIONS
from colift.benchmark.twin.libraries import require_jax
from colift.cli.interrupts import reported_interrupt
from colift.cli.options import Device, Jobs, LayoutName, chosen_layout
from colift.cli.remedies import argument
from colift.cli.settings import with_settings
from colift.cli.tables.training import training_table
from typer.core import TyperGroup

MOST_SEEDS = 100

Seeds = Annotated[
    int, typer.Option(metavar="N", help="Number of trainings, with the seeds 0 to N-1.")
]
Out = Annotated[
    Path, typer.Option(metavar="DIR", help="Folder for the policies; the same folder resumes.")
]

Train = Callable[..., None]
"""A function that trains a course with settings, and reports ``progress``; ``executor`` plays."""


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


def add(
    name: str,
    place: str,
    settings: type[Any],
    *options: str,
    meaning: str,
    total: Callable[[Any], int] = lambda settings: settings.updates,
    jax: bool = True,
    **words: Mapping[str, str],
) -> None:
    """Add a trainer as a command.

    Parameters
    ----------
    name, meaning
        The command and its help.
    place
        ``module:function`` in ``benchmark.training``.
    settings, options, words
        What is an option, as in :func:`.with_settings`.
    total
        Returns the length of the bar of progress, from the settings.
    jax
        Whether it computes with JAX, on one device; else it plays lifts in worker processes.
    """

    def train(out: Path, seeds: int, settings: Any, jobs: int | None, layout: str) -> None:
        size = chosen_layout(layout)
        module, _, function = place.partition(":")
        trainer = getattr(import_module(f"colift.benchmark.training.{module}"), function)
        train_all(name, settings, seeds, out, total(settings), jobs, trainer, size)

    def on_device(
        *,
        out: Out,
        seeds: Seeds = 1,
        settings: Any,
        device: Device = None,
        layout: LayoutName = PAGE.name,
    ) -> None:
        require_jax(device)
        train(out, seeds, settings, 1, layout)

    def in_workers(
        *,
        out: Out,
        seeds: Seeds = 1,
        settings: Any,
        jobs: Jobs = None,
        layout: LayoutName = PAGE.name,
    ) -> None:
        train(out, seeds, settings, jobs, layout)

    chosen = on_device if jax else in_workers
    chosen.__doc__ = meaning
    app.command(name)(with_settings(chosen, settings, *options, **words))


add(
    cem.NAME,
    "cem:train_cem",
    cem.CemSettings,
    "generations",
    "population",
    "elite",
    "lifts",
    meaning="Train a small network by the cross-entropy method, in the engine, in minutes, with "
    "NumPy.\n\nExample: colift train cem --out trained",
    total=lambda settings: settings.generations * settings.lifts,
    jax=False,
)
add(
    apg_settings.NAME,
    "apg_course:train_apg",
    ApgSettings,
    *ApgSettings.__dataclass_fields__,
    meaning="Train a recurrent network by gradients through whole lifts of the twin (extra: "
    "train).\n\nExample: colift train apg --task ball --out trained",
    task={"help": "Task: level, or one that is stated by rules."},
)


def train_all(
    trainer: str,
    settings: Any,
    seeds: int,
    out: Path,
    total: int,
    jobs: int | None,
    train: Train,
    layout: Layout,
) -> None:
    """Train all seeds, draw their curves and print their table.

    Finished ones are not trained again.
    """
    if not 1 <= seeds <= MOST_SEEDS:
        raise InputError(f"--seeds must be 1 to {MOST_SEEDS}, got {seeds}")
    courses = []
    resumable = reported_interrupt(f"{out} has the checkpoints; the same command resumes")
    with resumable, local_pool(jobs) as pool:
        workers = {} if pool is None else {"executor": pool}
        for seed in range(seeds):
            with _shown(seed, total) as (report, progress):
                course = open_course(out, trainer, settings, seed, report)
                if not (course.policy.exists() and course.load()):
                    train(settings, course, progress=progress, **workers)
                courses.append(course)
    show(training_table(trainer, courses))
    # matplotlib is slow to load.
    from colift.benchmark.rendering.figures import drawn_for, write_all
    from colift.benchmark.training.curves_figure import curves_figure

    with drawn_for(layout):
        figure = curves_figure(courses, layout)
    write_all(out, "curves", figure, f"Trained by {trainer}: error on the validation lifts")
    print(f"written: {write_summary(courses)}, and the curves: {out / 'curves.svg'}, .pdf, .png")
    best = min(courses, key=lambda course: course.curve[-1].rmse_mm).policy
    print(f"Next: {next_commands(argument(best), settings)}")


def next_commands(policy: str, settings: Any) -> str:
    """Return the commands that play a trained policy in its suite, or else in a lift."""
    task = getattr(settings, "task", LEVEL.name)
    suite = SESSIONS if getattr(settings, "session", "") else _suite_of(task)
    if suite is None:
        return f"colift render {policy} --task {task} --out lift.png"
    on = "" if suite == STANDARD_SUITE else f" --suite {suite}"
    return f"colift run {policy}{on}, or colift check {policy}{on}"


def _suite_of(task: str) -> str | None:
    """Return the first suite of a task, one of colift's own if possible; None if there is none."""
    for name in (STANDARD_SUITE, *own_entries(SUITES), *entries(SUITES)):
        with suppress(InputError):  # Other packages' suites may be faulty.
            if make_suite(name).scenarios[0].task.name == task:
                return name
    return None


@contextmanager
def _shown(
    seed: int, total: int
) -> Iterator[tuple[Callable[[Point], None], Callable[[int], None]]]:
    """Show the progress of a training; yield the callbacks for points of its curve and progress."""
    with job_bar(f"seed {seed}", total) as bar:

        def report(point: Point) -> None:
            bar.stage(f"seed {seed}: {point.rmse_mm:.2f} mm")

        yield report, bar.advance
