"""The bodies of many people as arrays: impedance, mass, and delayed reflexes."""

import math
from collections.abc import Sequence
from typing import Final, NamedTuple

import jax
import jax.numpy as jnp
import numpy as np

from ...agents.agent import FRAME
from ...agents.errors import InputError
from ..world.human_body import MUSCLE_TIME, REFLEX_LIMIT, BodyParameters
from ..world.table import GRIP_STIFFNESS, TABLE_LENGTH

DEPTH: Final = 26
"""Frames of the past that are kept: delays of up to 250 ms."""

CHUNK: Final = 5
"""Most frames that are made at once: reflexes must be older, so that they need none of these."""

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
    """(DEPTH, n) 1 at the visual delay in frames, else 0."""
    felt: jax.Array
    """(DEPTH, n) 1 at the haptic delay in frames, else 0."""


def one_hot(frames: Sequence[int]) -> jax.Array:
    """Return the rows (DEPTH, n) that pick a value so many frames old from a history."""
    return jnp.asarray(np.arange(DEPTH)[:, np.newaxis] == np.asarray(frames), jnp.float32)


def bodies(people: Sequence[BodyParameters]) -> Body:
    """Return the bodies of people as arrays.

    Raises
    ------
    InputError
        If a delay is outside what the twin keeps.
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
        return jnp.asarray(values, jnp.float32)

    implicit = [1 + FRAME * each.damping / each.mass / 2 for each in people]
    felt = [each.felt_share * each.pull for each in people]
    return Body(
        mass=column([each.mass for each in people]),
        stiffness=column([each.stiffness / by for each, by in zip(people, implicit, strict=True)]),
        damping=column([each.damping / by for each, by in zip(people, implicit, strict=True)]),
        visual_gain=column([each.pull - share for each, share in zip(people, felt, strict=True)]),
        haptic_gain=column([share * TABLE_LENGTH**2 / GRIP_STIFFNESS for share in felt]),
        seen=one_hot(visual),
        felt=one_hot(haptic),
    )


def delayed(history: jax.Array, delay: jax.Array, frames: int) -> list[jax.Array]:
    """Return the delayed values (n,) that are due in each of the next frames.

    Parameters
    ----------
    history
        (DEPTH, n) values, newest first.
    delay
        (DEPTH, n) rows of :func:`one_hot`: of delays of at least ``frames - 1``.
    frames
        How many frames.
    """
    return [(delay[i:] * history[: DEPTH - i]).sum(axis=0) for i in range(frames)]


def pushed(history: jax.Array, new: Sequence[jax.Array]) -> jax.Array:
    """Return a history (DEPTH, n), newest first, after new frames, oldest first."""
    return jnp.concatenate((jnp.stack(new[::-1]), history[: DEPTH - len(new)]))


def reflexes(
    body: Body, reflex: jax.Array, difference: list[jax.Array], force: list[jax.Array]
) -> list[jax.Array]:
    """Return the reflex's shift of the reference [m] in each frame; see :meth:`.HumanBody.reflex`.

    Parameters
    ----------
    body
        The people.
    reflex
        (n,) the shift in the last frame [m].
    difference, force
        For each frame, the height of the other end above the own [m] and the force beyond the
        share of the weight [N], as old as they are seen and felt.
    """
    shifts = []
    for seen, felt in zip(difference, force, strict=True):
        wanted = body.visual_gain * seen - body.haptic_gain * felt
        wanted = jnp.clip(wanted, -REFLEX_LIMIT, REFLEX_LIMIT)
        reflex = reflex + _ACTIVATION * (wanted - reflex)
        shifts.append(reflex)
    return shifts
