"""``colift train clone`` and ``colift train iql``: policies learned from a data set alone."""

import dataclasses
import importlib
from collections.abc import Callable
from concurrent.futures import Executor
from pathlib import Path
from typing import Annotated, Any, Final

import typer

from ..agents.errors import InputError
from ..agents.extras import how_to_install
from ..benchmark.training.course import Course
from ..benchmark.training.offline_data import read_data
from .options import Jobs
from .train import Out, Seeds, _train_all, app

UPDATES: Final = 10_000
"""Updates of the networks."""

Data = Annotated[
    Path, typer.Argument(metavar="DATA", help="Minari data set: a folder of 'colift export'.")
]
Updates = Annotated[
    int, typer.Option(metavar="N", help="Updates of the networks, a multiple of 500.")
]


@app.command()
def clone(
    data: Data, out: Out, seeds: Seeds = 1, updates: Updates = UPDATES, jobs: Jobs = None
) -> None:
    """Clone the behaviour in a data set, from the file alone."""
    _learn("cloning", data, out, seeds, {"updates": updates}, jobs)


@app.command()
def iql(
    data: Data,
    out: Out,
    seeds: Seeds = 1,
    updates: Updates = UPDATES,
    gamma: Annotated[
        float | None, typer.Option(metavar="G", help="Discount per step; default: 0.7.")
    ] = None,
    expectile: Annotated[
        float | None,
        typer.Option(metavar="T", help="0.5 for the mean action, near 1 for the best; 0.9."),
    ] = None,
    beta: Annotated[
        float | None, typer.Option(metavar="B", help="Weight of better actions; 0 clones; 3.")
    ] = None,
    jobs: Jobs = None,
) -> None:
    """Learn from a data set by implicit Q-learning, from the file alone."""
    chosen = {"updates": updates, "gamma": gamma, "expectile": expectile, "beta": beta}
    settings = {name: value for name, value in chosen.items() if value is not None}
    _learn("iql", data, out, seeds, settings, jobs)


def _learn(
    module: str,
    folder: Path,
    out: Path,
    seeds: int,
    changes: dict[str, Any],
    jobs: int | None,
) -> None:
    """Train all seeds by one of the modules that need JAX."""
    trainer, run = _with_jax(module), _with_jax("offline_run")
    kind = trainer.CloneSettings if module == "cloning" else trainer.IqlSettings
    settings = kind(**changes)
    data = read_data(folder)
    settings = dataclasses.replace(settings, data=data.digest)

    def train(course: Course, executor: Executor | None, progress: Callable[[int], None]) -> None:
        run.train(
            trainer.learning(settings, data, course.seed),
            data,
            course,
            updates=settings.updates,
            batch=settings.batch,
            executor=executor,
            progress=progress,
        )

    _train_all(trainer.NAME, settings, seeds, out, settings.updates, jobs, train)


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
