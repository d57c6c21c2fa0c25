"""``colift train clone`` and ``colift train iql``: policies learned from a data set alone."""

import dataclasses
import importlib
from collections.abc import Callable
from concurrent.futures import Executor
from pathlib import Path
from typing import Annotated, Any

import typer
from colift.base.errors import InputError
from colift.base.extras import how_to_install
from colift.benchmark.training.course import Course
from colift.benchmark.training.offline_data import read_data
from colift.benchmark.training.offline_settings import CLONE, IQL, CloneSettings, IqlSettings
from colift.cli.options import Jobs
from colift.cli.settings import with_settings
from colift.cli.train import Out, Seeds, app, train_all

Data = Annotated[
    Path, typer.Argument(metavar="DATA", help="Minari data set: a folder of 'colift export'.")
]


def _command(name: str, module: str, meaning: str) -> Callable[..., None]:
    """Return the command of a trainer, without the options of its settings."""

    def command(
        *, data: Data, out: Out, seeds: Seeds = 1, settings: CloneSettings, jobs: Jobs = None
    ) -> None:
        trainer, run = _with_jax(module), _with_jax("offline_run")
        steps = read_data(data)

        def train(
            settings: CloneSettings,
            course: Course,
            *,
            executor: Executor | None = None,
            progress: Callable[[int], None],
        ) -> None:
            run.train_offline(
                trainer.learning(settings, steps, course.seed),
                steps,
                course,
                updates=settings.updates,
                batch=settings.batch,
                executor=executor,
                progress=progress,
            )

        settings = dataclasses.replace(settings, data=steps.digest)
        train_all(name, settings, seeds, out, settings.updates, jobs, train)

    command.__doc__ = meaning
    return command


app.command(CLONE)(
    with_settings(
        _command(
            CLONE,
            "cloning",
            "Clone the behaviour in a data set, from the file alone (extras: export, train).",
        ),
        CloneSettings,
        "updates",
    )
)
app.command(IQL)(
    with_settings(
        _command(
            IQL,
            "iql",
            "Learn from a data set by implicit Q-learning, from the file alone (extras: export, "
            "train).",
        ),
        IqlSettings,
        "updates",
        "gamma",
        "expectile",
        "beta",
        gamma={"metavar": "G"},
        expectile={"metavar": "T"},
        beta={"metavar": "B"},
    )
)


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
