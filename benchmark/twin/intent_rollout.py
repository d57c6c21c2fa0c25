"""Whole lifts with an intended pose, with a policy and with a person who learns."""

from typing import Any, Final, NamedTuple

import jax
import jax.numpy as jnp

from ...agents.agent import FRAME
from .arm import ArmVariation
from .body import delayed
from .haptic_playing import sensed_by_hands
from .intent_lifts import IntentLifts
from .intent_playing import IntentDue, IntentState, intent_at_rest, intent_step, planned
from .rollout import Policy

LOOKS_AHEAD: Final = (10.0, 30.0, 60.0)
"""Frames ahead at which a learning person knows the own intention."""


class LearningPerson(NamedTuple):
    """A person at the near end who has learned to add to what the hands do by themselves."""

    policy: Policy
    """Returns memory and additions (2, n), each of at most 1, for a memory and a view (9, n)."""
    memory: Any
    """The memory at the beginning."""


def person_view(state: IntentState, lifts: IntentLifts) -> jax.Array:
    """Return what n persons know (9, n): their senses, as late as they are, and their intention.

    Height of the own end and the difference of the far one, as seen, the felt force, and for three
    times ahead the intended height of the own end and the intended difference of the far one.
    """
    plant, body = state.haptic.plant, lifts.body
    ahead = state.time + jnp.asarray(LOOKS_AHEAD)[:, jnp.newaxis]
    near = planned(lifts.near, ahead)
    seen = (delayed(series, body.seen, 1) for series in (plant.heights, plant.differences))
    felt = delayed(plant.forces, body.felt, 1)
    return jnp.concatenate((*seen, felt, near, planned(lifts.far, ahead) - near))


def intent_rmse_mm(
    policy: Policy,
    memory: Any,
    lifts: IntentLifts,
    variation: ArmVariation | None = None,
    person: LearningPerson | None = None,
) -> jax.Array:
    """Return the RMSE of the pose (n,) [mm] of lifts with a policy; differentiable.

    Parameters
    ----------
    policy, memory
        The policy, and its memory at the beginning.
    lifts
        People, plans and noise.
    variation
        Arms that differ from the benchmark's; none: its own.
    person
        A person who has learned; none: the benchmark's.
    """
    longest, size, count = lifts.gain.shape
    plans = (each.reshape(longest, size, count) for each in (lifts.near, lifts.far))

    def step(
        held: tuple[IntentState, Any, Any],
        now: tuple[IntentDue, jax.Array, jax.Array, jax.Array],
    ) -> tuple[tuple[IntentState, Any, Any], jax.Array]:
        (state, memory, knowing), (due, noise, near, far) = held, now
        added = None
        if person is not None:
            knowing, added = person.policy(knowing, person_view(state, lifts))
        time = state.step * size * FRAME
        view = sensed_by_hands(state.haptic, state.command, time, noise, lifts.latency)
        memory, action = policy(memory, view)
        valid = (state.step < lifts.steps).astype(jnp.float32)
        state, frames = intent_step(state, lifts, due, action, variation, added)
        squares = ((frames.human_end - near) ** 2 + (frames.robot_end - far) ** 2).sum(axis=0) / 2
        return (state, memory, knowing), squares * valid

    _, squares = jax.lax.scan(
        jax.checkpoint(step),
        (intent_at_rest(count), memory, None if person is None else person.memory),
        (IntentDue(lifts.gain, lifts.tremor), lifts.noise, *plans),
    )
    return 1000 * jnp.sqrt(squares.sum(axis=0) / (lifts.steps * size) + 1e-12)
