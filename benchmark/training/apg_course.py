"""The training by gradients through the twin, in its folder: checkpoints, curve, submission."""

import time
from collections.abc import Callable
from typing import Any, Final

import jax
import jax.numpy as jnp
import numpy as np
from colift.benchmark.training.apg import Learner, first_learner, updates
from colift.benchmark.training.apg_settings import ApgSettings
from colift.benchmark.training.course import Course, Point, check_finite
from colift.benchmark.training.lessons import lesson_for
from colift.benchmark.training.result import write_policy
from numpy.typing import NDArray

EVERY: Final = 100
"""Fewest updates between two points of the curve."""

POINTS: Final = 20
"""Most points of a curve."""


def train_apg(
    settings: ApgSettings, course: Course, progress: Callable[[int], None] = lambda many: None
) -> None:
    """Train, or continue where the course was interrupted, and write the policy.

    Parameters
    ----------
    settings
        The settings of the training.
    course
        Its folder and seed.
    progress
        Called with the number of updates since the last call.

    Raises
    ------
    InputError
        If the course cannot be resumed, the training diverges, or a file cannot be written.
    """
    lesson = lesson_for(settings)
    learner = first_learner(settings, course.seed, lesson)
    state = course.load(_shapes(learner))
    if state is not None:
        learner = _unpacked(learner, state)
        progress(learner.update)
    start = time.perf_counter() - course.seconds
    pool, validation = lesson.draw(settings), lesson.validation()
    errors = jax.jit(lambda network: lesson.errors(network, validation))
    every = max(EVERY, settings.updates // POINTS)
    steps_of_update = settings.batch * lesson.steps(pool)
    for update in updates(settings, course.seed, learner, pool, lesson):
        learner = update.learner
        check_finite(f"the RMSE of update {learner.update}", np.array(update.rmse_mm))
        progress(1)
        if learner.update % every == 0 or learner.update == settings.updates:
            error = float(errors(learner.network).mean())
            steps = round(learner.update * steps_of_update)
            point = Point(steps, time.perf_counter() - start, error)
            course.keep(point, _packed(learner))
    write_policy(
        course,
        lesson.weights(learner.network),
        lesson.about(settings),
        package=lesson.package,
        check=lesson.check,
    )


def _packed(learner: Learner) -> dict[str, NDArray[Any]]:
    leaves = jax.tree.leaves((learner.network, learner.optimiser))
    named = {f"leaf{i}": np.asarray(leaf) for i, leaf in enumerate(leaves)}
    return {**named, "update": np.array(learner.update)}


def _shapes(learner: Learner) -> dict[str, tuple[int, ...]]:
    return {name: array.shape for name, array in _packed(learner).items()}


def _unpacked(learner: Learner, state: dict[str, NDArray[Any]]) -> Learner:
    known, tree = jax.tree.flatten((learner.network, learner.optimiser))
    leaves = [jnp.asarray(state[f"leaf{i}"]) for i in range(len(known))]
    network, optimiser = jax.tree.unflatten(tree, leaves)
    return Learner(network, optimiser, int(state["update"]))
