"""Whole lifts of the twin with a policy at the robot's end, as one function."""

from functools import partial
from typing import Any, NamedTuple

import jax
import jax.numpy as jnp
from colift.benchmark.twin.learning_person import LearningPerson, added_in_step, person_senses
from colift.benchmark.twin.lifts import Lifts, Share, shares
from colift.benchmark.twin.policy import Policy
from colift.benchmark.twin.task_twin import TaskTwin


class Seen(NamedTuple):
    """What the people of n lifts have seen at the end, and the policy's memory there."""

    near: jax.Array
    """(T, n) height of the own end in each frame [m]."""
    far: jax.Array
    """(T, n) height of the other end [m]; after the end of a shorter lift, that of the own one."""
    memory: Any


class Outcome(NamedTuple):
    """Figures of n lifts."""

    rmse_mm: jax.Array
    """(n,) score of the task [mm]."""
    bend_mm: jax.Array
    """(n,) root mean square of the second differences of the command [mm]."""
    force_n: jax.Array
    """(n,) root mean square force of the human's hands, beyond the share of the weight [N]."""
    seen: Seen | None = None


def rollout(
    twin: TaskTwin,
    policy: Policy,
    memory: Any,
    lifts: Lifts,
    *,
    person: LearningPerson | None = None,
    told: jax.Array | None = None,
    seen: bool = False,
) -> Outcome:
    """Return the outcome of lifts with a policy; differentiable in all arrays.

    Drops of the table are not modelled.

    Parameters
    ----------
    twin
        The rules of the lifts.
    policy, memory
        The policy, and its memory at the beginning.
    lifts
        People, plans, noise and arms.
    person
        A person who has learned; None is the benchmark's.
    told
        (s, k, n) numbers that follow the observation of a policy that is told more; None tells
        nothing.
    seen
        Whether to return what is left for the next lift.
    """
    more = jnp.zeros((lifts.longest, 0, lifts.size)) if told is None else told

    def step(
        held: tuple[Any, Any, Any], now: tuple[Share, jax.Array]
    ) -> tuple[tuple[Any, Any, Any], Any]:
        (state, memory, minding), (share, extra) = held, now
        added = None
        if person is not None:
            mind, before = minding
            own = (person_senses(state.plant, lifts.body), twin.known(state, lifts, share))
            mind, after = person.policy(mind, jnp.concatenate(own))
            minding, added = (mind, after), added_in_step(before, after, lifts.frames)
        view = twin.observe(state, lifts, share)
        before = memory
        memory, action = policy(memory, jnp.concatenate((view, extra)))
        if seen:  # What is left for the next lift is the memory at this one's own end.
            lasting = state.step < lifts.steps
            memory = jax.tree.map(partial(jnp.where, lasting), memory, before)
        later, ends = twin.step(state, lifts, share, action, added)
        lasts = (state.step < lifts.steps).astype(view.dtype)
        force = (later.plant.forces[: lifts.frames] ** 2).mean(axis=0) * lasts
        change = (later.command - state.command) * lasts
        heights = (ends.near, jnp.where(lasts > 0, ends.far, ends.near)) if seen else ()
        missed = twin.missed(state, later, lifts, ends)
        return (later, memory, minding), (missed, force, change, heights)

    minding = None if person is None else (person.memory, jnp.zeros((2, lifts.size)))
    begun = (twin.at_rest(lifts), memory, minding)
    (_, memory, _), (missed, forces, changes, heights) = jax.lax.scan(
        jax.checkpoint(step), begun, (shares(lifts), more)
    )
    bends = (jnp.diff(changes, axis=0) ** 2).sum(axis=0) / lifts.steps
    return Outcome(
        rmse_mm=twin.score_mm(lifts, missed),
        bend_mm=1000 * jnp.sqrt(bends + 1e-12),
        force_n=jnp.sqrt(forces.sum(axis=0) / lifts.steps + 1e-12),
        seen=Seen(*_joined(heights, lifts.size), memory=memory) if seen else None,
    )


def _joined(heights: tuple[jax.Array, ...], count: int) -> tuple[jax.Array, jax.Array]:
    """Return the heights of both ends (T, n), from those of steps (s, f, n)."""
    near, far = (each.reshape(-1, count) for each in heights)
    return near, far
