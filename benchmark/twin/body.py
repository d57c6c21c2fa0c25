"""The bodies of many people as arrays: impedance, mass, and delayed reflexes."""

import math
from collections.abc import Sequence
from typing import Final, NamedTuple

import jax
import jax.numpy as jnp
from colift.agents.agent import FRAME
from colift.base.errors import InputError
from colift.benchmark.world.human_body import MUSCLE_TIME, REFLEX_LIMIT, BodyParameters
from colift.benchmark.world.table import GRIP_STIFFNESS, TABLE_LENGTH

DEPTH: Final = 26
"""Frames of the past that are kept: delays of up to 250 ms."""

CHUNK: Final = 5
"""Most frames that are made at once: reflexes must have longer delays, so that they need none of
these frames."""

_ACTIVATION: Final = -math.expm1(-FRAME / MUSCLE_TIME)


class Body(NamedTuple):
    """The arms of n people; see :class:`.HumanBody` for the equations."""

    mass: jax.Array
    """(n,) M [kg]."""
    stiffness: jax.Array
    """(n,) K of the semi-implicit step [N/m]."""
    damping: jax.Array
    """(n,) B of the semi-implicit step [N s/m]."""
    visual_gain: jax.Array
    """(n,) shift of the reference for a seen height difference [m/m]."""
    haptic_gain: jax.Array
    """(n,) shift of the reference for a felt force [m/N]."""
    seen: jax.Array
    """(n,) visual delay in frames."""
    felt: jax.Array
    """(n,) haptic delay in frames."""
    load: jax.Array
    """(n,) mass of their table relative to the benchmark's."""


def bodies(
    people: Sequence[BodyParameters], step: float = FRAME, loads: Sequence[float] = ()
) -> Body:
    """Return the bodies of people as arrays, for physics steps of ``step`` [s].

    ``loads`` are the masses of their tables relative to the benchmark's; by default, all are 1.

    Raises
    ------
    InputError
        If a delay is outside the range that the twin keeps.
    """
    visual = [round(each.visual_delay / FRAME) for each in people]
    haptic = [round(each.haptic_delay / FRAME) for each in people]
    for name, delays in (("visual_delay", visual), ("haptic_delay", haptic)):
        for delay in delays:
            if not CHUNK - 1 <= delay < DEPTH:
                low, high = (CHUNK - 1) * FRAME, (DEPTH - 1) * FRAME
                raise InputError(
                    f"the twin models a {name} of {low:g} to {high:g} s, got {delay * FRAME:g} s"
                )

    def column(values: Sequence[float]) -> jax.Array:
        return jnp.asarray(values, float)

    implicit = [1 + step * each.damping / each.mass / 2 for each in people]
    felt = [each.felt_share * each.pull for each in people]
    return Body(
        mass=column([each.mass for each in people]),
        stiffness=column([each.stiffness / by for each, by in zip(people, implicit, strict=True)]),
        damping=column([each.damping / by for each, by in zip(people, implicit, strict=True)]),
        visual_gain=column([each.pull - share for each, share in zip(people, felt, strict=True)]),
        haptic_gain=column([share * TABLE_LENGTH**2 / GRIP_STIFFNESS for share in felt]),
        seen=jnp.asarray(visual),
        felt=jnp.asarray(haptic),
        load=column(loads or [1.0] * len(people)),
    )


def delayed(history: jax.Array, delay: jax.Array, frames: int) -> jax.Array:
    """Return the delayed values (frames, n) that are due in each of the next frames.

    Parameters
    ----------
    history
        Values, newest first, of at least :data:`DEPTH` frames.
    delay
        (n,) delays in frames, of at least ``frames - 1``.
    frames
        Number of frames.
    """
    ages = delay - jnp.arange(frames)[:, jnp.newaxis]
    return jnp.take_along_axis(history, ages, axis=0)


def pushed(history: jax.Array, new: jax.Array) -> jax.Array:
    """Return a history, newest first, after new frames (frames, ...), oldest first."""
    return jnp.concatenate((new[::-1], history[: len(history) - len(new)]))


def wanted_shift(body: Body, difference: jax.Array, force: jax.Array) -> jax.Array:
    """Return the shift of the reference that the reflexes want [m].

    Parameters
    ----------
    body
        The people.
    difference, force
        (..., n) seen height of the other end above the person's [m], and felt force beyond the
        share of the weight [N].
    """
    wanted = body.visual_gain * difference - body.haptic_gain * force
    return jnp.clip(wanted, -REFLEX_LIMIT, REFLEX_LIMIT)


def activated(reflex: jax.Array, wanted: jax.Array) -> jax.Array:
    """Return the reflex's shift [m] a frame later; see :meth:`.HumanBody.reflex`."""
    return reflex + _ACTIVATION * (wanted - reflex)
