"""The training by gradients through the twin, in its folder: checkpoints, curve, submission."""

import time
from collections.abc import Callable
from functools import partial
from typing import Any, Final

import jax
import jax.numpy as jnp
import numpy as np
from numpy.typing import NDArray

from ...agents.control.recurrent import GatedNetwork, network_of
from ...agents.control.recurrent_controller import RecurrentController
from ...agents.submissions import recurrent
from .anticipation import FIRST_SEED
from .apg import Learner, first_learner, updates
from .apg_settings import ApgSettings
from .course import Course, Point, check_finite
from .pool import draw_pool
from .result import write_policy
from .validation import validation_error

EVERY: Final = 100
"""Fewest updates between two points of the curve."""

POINTS: Final = 20
"""Most points of a curve: each takes forty lifts in the engine."""


def train_apg(
    settings: ApgSettings, course: Course, progress: Callable[[int], None] = lambda many: None
) -> None:
    """Train, or go on where the course was interrupted, and write the policy.

    Parameters
    ----------
    settings
        Of the training.
    course
        Its folder and seed.
    progress
        Called with the number of updates since the last call.

    Raises
    ------
    InputError
        If the course cannot be resumed, the training diverges, or a file cannot be written.
    """
    learner = first_learner(settings, course.seed)
    state = course.load(_shapes(learner))
    if state is not None:
        learner = _unpacked(learner, state)
        progress(learner.update)
    start = time.perf_counter() - course.seconds
    pool = draw_pool(settings.lifts, settings.wide)
    every = max(EVERY, settings.total // POINTS)
    steps_of_update = settings.batch * float(pool.lifts.steps.mean())
    for update in updates(settings, course.seed, learner, pool):
        learner = update.learner
        check_finite(f"the RMSE of update {learner.update}", np.array(update.rmse_mm))
        progress(1)
        if learner.update % every == 0 or learner.update == settings.total:
            network = in_numpy(learner.network)
            error = validation_error(partial(RecurrentController, network))
            steps = round(learner.update * steps_of_update)
            point = Point(steps, time.perf_counter() - start, error)
            course.keep(point, _packed(learner))
    write_policy(
        course,
        {name: np.asarray(array) for name, array in learner.network._asdict().items()},
        description=f"A straight line through the human's last heights, corrected by "
        f"{settings.units} gated recurrent units, trained by gradients through the twin.",
        trained_on=f"{settings.lifts} lifts of colift with drawn people, seeds {FIRST_SEED} to "
        f"{FIRST_SEED + settings.lifts - 1}, {settings.wide:.0%} of them with wide habits.",
        package=recurrent,
        check=partial(network_of, source="trained weights"),
    )


def in_numpy(network: GatedNetwork) -> GatedNetwork:
    """Return a network of JAX in NumPy, in double precision."""
    return network_of(network._asdict(), "trained weights")


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
