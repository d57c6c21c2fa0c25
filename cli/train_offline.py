"""``colift train clone`` and ``colift train iql``: policies learned from a data set alone."""

import dataclasses
import importlib
from collections.abc import Callable
from concurrent.futures import Executor
from pathlib import Path
from typing import Annotated, Any

import typer
from colift.agents.errors import InputError
from colift.agents.extras import how_to_install
from colift.benchmark.training.course import Course
from colift.benchmark.training.offline_data import read_data
from colift.benchmark.training.offline_settings import CLONE, IQL, CloneSettings, IqlSettings
from colift.cli.options import Jobs
from colift.cli.train import Out, Seeds, _train_all, app

Data = Annotated[
    Path, typer.Argument(metavar="DATA", help="Minari data set: a folder of 'colift export'.")
]
Updates = Annotated[
    int, typer.Option(metavar="N", help="Updates of the networks, a multiple of 500.")
]


@app.command(CLONE)
def clone(
    data: Data,
    out: Out,
    seeds: Seeds = 1,
    updates: Updates = CloneSettings.updates,
    jobs: Jobs = None,
) -> None:
    """Clone the behaviour in a data set, from the file alone (extras: export, train)."""
    _learn(CLONE, "cloning", CloneSettings(updates=updates), data, out, seeds, jobs)


@app.command(IQL)
def iql(
    data: Data,
    out: Out,
    seeds: Seeds = 1,
    updates: Updates = IqlSettings.updates,
    gamma: Annotated[
        float, typer.Option(metavar="G", help="Discount per step.")
    ] = IqlSettings.gamma,
    expectile: Annotated[
        float, typer.Option(metavar="T", help="0.5: values of the mean action; 1: of the best.")
    ] = IqlSettings.expectile,
    beta: Annotated[
        float, typer.Option(metavar="B", help="Weight of better actions; 0 clones.")
    ] = IqlSettings.beta,
    jobs: Jobs = None,
) -> None:
    """Learn from a data set by implicit Q-learning, from the file alone (extras: export, train)."""
    settings = IqlSettings(updates=updates, gamma=gamma, expectile=expectile, beta=beta)
    _learn(IQL, "iql", settings, data, out, seeds, jobs)


def _learn(
    name: str,
    module: str,
    settings: CloneSettings | IqlSettings,
    folder: Path,
    out: Path,
    seeds: int,
    jobs: int | None,
) -> None:
    """Train all seeds by one of the modules that need JAX."""
    trainer, run = _with_jax(module), _with_jax("offline_run")
    data = read_data(folder)
    settings = dataclasses.replace(settings, data=data.digest)

    def train(course: Course, executor: Executor | None, progress: Callable[[int], None]) -> None:
        run.train_offline(
            trainer.learning(settings, data, course.seed),
            data,
            course,
            updates=settings.updates,
            batch=settings.batch,
            executor=executor,
            progress=progress,
        )

    _train_all(name, settings, seeds, out, settings.updates, jobs, train)


def _with_jax(module: str) -> Any:
    """Return a module of the trainings that need JAX.

    Raises
    ------
    InputError
        If JAX or optax is not installed.
    """
    try:
        importlib.import_module("jax")
        importlib.import_module("optax")
    except ImportError as error:
        raise InputError(f"training needs JAX and optax: {how_to_install('train')}") from error
    return importlib.import_module(f"..benchmark.training.{module}", __package__)
