"""The course of a training by proximal policy optimisation: updates, checkpoints, curve."""

import time
from collections.abc import Callable
from concurrent.futures import Executor
from functools import partial
from typing import Final, TypeVar

import jax
import jax.numpy as jnp
import numpy as np
from colift.agents.submissions.network.policy import Policy
from colift.benchmark.training.course import Course, Point
from colift.benchmark.training.result import Weights, checked_network
from colift.benchmark.training.validation import validation_error

POINTS: Final = 20
"""Points of a curve; each is a checkpoint."""

State = TypeVar("State")


def run_updates(
    course: Course,
    state: State,
    update: Callable[[State, int], tuple[State, int]],
    updates: int,
    *,
    policy: Callable[[State], Weights],
    executor: Executor | None = None,
    progress: Callable[[int], None] = lambda updates: None,
) -> State:
    """Return the state after all updates; those up to the last checkpoint are not repeated.

    Parameters
    ----------
    course
        Keeps the checkpoints and the curve, whose errors are those of the engine.
    state
        The initial state: arrays in named tuples and dictionaries.
    update
        Returns the state after one more update, and the steps that were played for it. It is
        called with the number of the update, from 0, and depends on nothing else that changes.
    updates
        Number of updates.
    policy
        Returns the weights of a state's robot.
    executor
        Plays the lifts of the curve; None plays them in this process.
    progress
        Called with the number of updates that were finished since the last call.

    Raises
    ------
    InputError
        If the course cannot be resumed, the training diverges, or a file cannot be written.
    """
    begin, first = time.perf_counter(), 0
    leaves, structure = jax.tree.flatten(state)
    shapes = {f"leaf{i}": np.shape(leaf) for i, leaf in enumerate(leaves)}
    stored = course.load({**shapes, "update": ()})
    if stored is not None:
        leaves = [jnp.asarray(stored[name]) for name in shapes]
        state, first = jax.tree.unflatten(structure, leaves), int(stored["update"])
        progress(first)
    begin -= course.seconds
    steps, every = course.steps, max(updates // POINTS, 1)
    for number in range(first, updates):
        state, played = update(state, number)
        steps += played
        progress(1)
        if (number + 1) % every == 0 or number + 1 == updates:
            kept = zip(shapes, map(np.asarray, jax.tree.leaves(state)), strict=True)
            network = checked_network(policy(state))
            error = validation_error(partial(Policy, network), executor)
            point = Point(steps, time.perf_counter() - begin, error)
            course.keep(point, {**dict(kept), "update": np.array(number + 1)})
    return state
