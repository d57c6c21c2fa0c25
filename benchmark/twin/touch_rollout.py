"""Whole lifts of the twins of tasks with touch, with a policy and with a person who learns."""

from collections.abc import Callable
from typing import Any, NamedTuple

import jax
import jax.numpy as jnp
from colift.benchmark.twin.arm import ArmVariation
from colift.benchmark.twin.learning_person import LearningPerson, added_in_step, person_senses
from colift.benchmark.twin.rollout import Policy


class TouchSteps(NamedTuple):
    """The lifts of a task with touch, step by step, as functions of n lifts."""

    at_rest: Callable[[int], Any]
    """Returns the state of a number of lifts before the first step."""
    shares: Callable[[Any], Any]
    """Returns the shares of all steps in the lifts, with a first axis of steps."""
    view: Callable[[Any, Any, Any], jax.Array]
    """Returns the robot's observations (k, n) from state, lifts and share."""
    known: Callable[[Any, Any, Any], jax.Array]
    """Returns the people's knowledge about their task (k, n), from state, lifts and share, of the
    order of 1."""
    knows: int
    """Number of rows of ``known``."""
    step: Callable[..., tuple[Any, Any]]
    """Returns the state after a step, and its frames, from state, lifts, share, actions (n,) [m],
    variation of the arms and :class:`.Added`."""
    missed: Callable[[Any, Any, Any, Any], Any]
    """Returns the contribution of a step to the score, from the state before it, lifts, share and
    frames."""
    score_mm: Callable[[Any, Any], jax.Array]
    """Returns the scores (n,) [mm] from lifts and the contributions of their steps, with a first
    axis of steps."""


def touch_rmse_mm(
    steps: TouchSteps,
    policy: Policy,
    memory: Any,
    lifts: Any,
    variation: ArmVariation | None = None,
    person: LearningPerson | None = None,
) -> jax.Array:
    """Return the scores (n,) [mm] of lifts with a policy; differentiable.

    Drops of the table are not modelled.

    Parameters
    ----------
    steps
        The steps of the task.
    policy, memory
        The policy, and its memory at the beginning.
    lifts
        People, plans and noise.
    variation
        Variation of the arms; None is the benchmark's arms.
    person
        A person who has learned; None is the benchmark's.
    """
    _, size, count = lifts.gain.shape

    def step(held: tuple[Any, Any, Any], share: Any) -> tuple[tuple[Any, Any, Any], Any]:
        state, memory, minding = held
        added = None
        if person is not None:
            mind, before = minding
            plant = state.haptic.plant
            view = (person_senses(plant, lifts.body), steps.known(state, lifts, share))
            mind, after = person.policy(mind, jnp.concatenate(view))
            minding, added = (mind, after), added_in_step(before, after, size)
        memory, action = policy(memory, steps.view(state, lifts, share))
        after_step, frames = steps.step(state, lifts, share, action, variation, added)
        return (after_step, memory, minding), steps.missed(state, lifts, share, frames)

    minding = None if person is None else (person.memory, jnp.zeros((2, count)))
    begun = (steps.at_rest(count), memory, minding)
    _, missed = jax.lax.scan(jax.checkpoint(step), begun, steps.shares(lifts))
    return steps.score_mm(lifts, missed)


def mean_error_mm(lifts: Any, squares: jax.Array) -> jax.Array:
    """Return the RMSE (n,) [mm] from the sums of squares in each step (s, n) [m2]."""
    return 1000 * jnp.sqrt(squares.sum(axis=0) / (lifts.steps * lifts.gain.shape[1]) + 1e-12)
