"""A training from a data set: blocks of updates, checkpoints, and the policy at the end. Needs JAX.

The training does not depend on the engine: offline, a learner sees only the file. The errors of the
curve come from the engine, for information only.
"""

import time
from collections.abc import Callable
from concurrent.futures import Executor
from dataclasses import dataclass
from functools import partial
from typing import Any, Final

import jax
import jax.numpy as jnp
import numpy as np
from colift.agents.submissions import offline
from colift.agents.submissions.offline.policy import Network, Policy
from colift.benchmark.training.course import Course, Point
from colift.benchmark.training.offline_data import OfflineData
from colift.benchmark.training.offline_settings import BLOCK
from colift.benchmark.training.perceptron import Layers, numpy_layers
from colift.benchmark.training.result import Weights, usable, write_policy
from colift.benchmark.training.validation import validation_error

POINTS: Final = 4
"""Points of a curve; each is a checkpoint."""


@dataclass(frozen=True, kw_only=True)
class Learning:
    """An algorithm with its data, for :func:`train_offline`."""

    start: Any
    """The initial state: arrays in tuples and lists."""
    arrays: tuple[jax.Array, ...]
    """The arrays of the data that it needs."""
    update: Callable[[Any, tuple[jax.Array, ...], jax.Array], Any]
    """Returns the state after one more update, from the arrays; the key draws some of their rows.

    It must not contain the arrays itself, since they would be compiled into the code."""
    actor: Callable[[Any], Layers]
    """Returns the layers of the policy of a state."""
    about: str
    """Description for the manifest."""


def train_offline(
    learning: Learning,
    data: OfflineData,
    course: Course,
    *,
    updates: int,
    batch: int,
    executor: Executor | None = None,
    progress: Callable[[int], None] = lambda updates: None,
) -> None:
    """Train a policy and write it into the folder of the course; resume it if it was interrupted.

    The weights follow from settings, data and seed.

    Parameters
    ----------
    learning, data
        Algorithm and data of the training.
    course
        The course, in whose folder the policy is written.
    updates, batch
        Number of updates, and steps of the data in each.
    executor
        Plays the lifts of the curve; None plays them in this process.
    progress
        Called with the number of updates that were made since the last call.

    Raises
    ------
    InputError
        If the course cannot be resumed, the training diverges, or a file cannot be written.
    """
    begin = time.perf_counter()
    leaves, structure = jax.tree.flatten(learning.start)
    shapes = {f"leaf{i}": np.shape(leaf) for i, leaf in enumerate(leaves)}
    stored, first, state = course.load({**shapes, "update": ()}), 0, learning.start
    if stored is not None:
        state = jax.tree.unflatten(structure, [jnp.asarray(stored[name]) for name in shapes])
        first = int(stored["update"])
        progress(first)
    begin -= course.seconds

    @jax.jit
    def block(state: Any, arrays: tuple[jax.Array, ...], key: jax.Array) -> Any:
        def step(state: Any, key: jax.Array) -> tuple[Any, None]:
            return learning.update(state, arrays, key), None

        return jax.lax.scan(step, state, jax.random.split(key, BLOCK))[0]

    every = max(updates // POINTS // BLOCK, 1) * BLOCK
    seed = jax.random.fold_in(jax.random.key(course.seed), 1)
    for done in range(first + BLOCK, updates + 1, BLOCK):
        state = block(state, learning.arrays, jax.random.fold_in(seed, done))
        progress(BLOCK)
        if done % every == 0 or done == updates:
            kept = zip(shapes, map(np.asarray, jax.tree.leaves(state)), strict=True)
            weights = _weights(learning.actor(state), data)
            policy = partial(Policy, usable(weights, Network))
            error = validation_error(policy, executor)
            point = Point(done * batch, time.perf_counter() - begin, error)
            course.keep(point, {**dict(kept), "update": np.array(done)})
    write_policy(
        course,
        _weights(learning.actor(state), data),
        description=learning.about,
        trained_on=f"{data.steps} steps of {data.lifts} lifts: the data set {data.name}, "
        f"SHA-256 {data.digest}.",
        package=offline,
        check=partial(usable, make=Network),
    )


def _weights(actor: Layers, data: OfflineData) -> Weights:
    return {**numpy_layers(actor), "centre": data.centre, "deviation": data.deviation}
