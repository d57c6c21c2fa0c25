"""Many lifts from drawn ones: what is cheap to draw is drawn anew, for all of them at once.

A lift of a seed takes the host long, most of it for the plan (``colift bench --twin`` compares).
Here a plan and its person's body are used again, with other noise of the hand, other errors of the
robot's senses and another manner. The distribution is that of :func:`.draw_lift`, with the given
plans instead of all.
"""

import math
from functools import partial
from typing import Any

import jax
import jax.numpy as jnp
from colift.agents.agent import FRAME
from colift.agents.humans.hand import KERNEL
from colift.agents.senses import SIGHT, TOUCH, Sense
from colift.base.errors import InputError
from colift.benchmark.twin.lifts import Lifts
from colift.benchmark.twin.people import with_new_manners
from colift.benchmark.twin.task_twin import TaskTwin


def many_lifts(twin: TaskTwin, lifts: Lifts, count: int, key: jax.Array) -> Lifts:
    """Return lifts with the plans of drawn ones in turn, and all else drawn anew.

    Parameters
    ----------
    twin
        The rules of the lifts.
    lifts
        The drawn lifts, without conditions.
    count
        Number of lifts to return.
    key
        Draws them.

    Raises
    ------
    InputError
        If the lifts have drawn conditions: errors and ages of samples then belong together.
    """
    if lifts.arms is not None:
        raise InputError("lifts with drawn conditions are drawn one by one")
    drawn: Lifts = _many(twin, lifts, count, key)
    return drawn


@partial(jax.jit, static_argnums=(0, 2))
def _many(twin: TaskTwin, lifts: Lifts, count: int, key: jax.Array) -> Lifts:
    gain, phase, errors, manner = jax.random.split(key, 4)
    found = in_turn(lifts, count)
    senses = (*SIGHT, *(TOUCH if twin.task.touch else ()), *twin.task.senses)
    found = found._replace(
        gain=found.hand.motor_noise * hand_noise(gain, found),
        tremor=tremor(phase, found),
        errors=sensor_errors(errors, senses, found.longest, count),
    )
    return with_new_manners(twin.person, found, manner, 0.0)


def in_turn(lifts: Lifts, count: int) -> Lifts:
    """Return the lifts again and again, ``count`` in all."""
    times = -(-count // lifts.size)

    def repeated(array: jax.Array) -> jax.Array:
        # Copies of whole blocks: faster than an index for each lift.
        return jnp.tile(array, (*[1] * (array.ndim - 1), times))[..., :count]

    found: Lifts = jax.tree.map(repeated, lifts)
    return found


def hand_noise(key: jax.Array, lifts: Lifts) -> jax.Array:
    """Return smooth noise of unit variance (s, f, n); see :class:`.NoiseStream`."""
    frames = lifts.longest * lifts.frames
    white = normals(key, (frames + len(KERNEL) - 1, lifts.size))
    return smoothed(white).reshape(lifts.longest, lifts.frames, lifts.size)


def smoothed(white: jax.Array) -> jax.Array:
    """Return the weighted means of successive numbers along the first axis."""
    frames = len(white) - len(KERNEL) + 1
    weighted = (weight * white[i : i + frames] for i, weight in enumerate(KERNEL.tolist()))
    return jnp.asarray(sum(weighted))


def normals(key: jax.Array, shape: tuple[int, ...]) -> jax.Array:
    """Return standard normal numbers, each of one in 65,536 values, within 4.33 deviations.

    A word of the generator takes most of the time, and serves for two of them.
    """
    words = jax.random.bits(key, (-(-shape[0] // 2), *shape[1:]), jnp.uint32)
    ranks = jnp.concatenate([words & 0xFFFF, words >> 16])[: shape[0]]
    return math.sqrt(2) * jax.scipy.special.erfinv((ranks.astype(jnp.float32) + 0.5) / 2**15 - 1)


def tremor(key: jax.Array, lifts: Lifts) -> jax.Array:
    r"""Return the tremor of the hands (s, f, n) [m]: sines of random phase.

    From step to step they turn by :math:`\sin(a + b) = \sin a \cos b + \cos a \sin b`, since a
    sine for each frame takes five times as long.
    """
    phase = 2 * math.pi * jax.random.uniform(key, (lifts.size,))
    frames = jnp.arange(lifts.frames + 1)[:, jnp.newaxis]
    angles = 2 * math.pi * FRAME * lifts.hand.tremor_frequency * frames
    sines, cosines = jnp.sin(angles), jnp.cos(angles)

    def step(now: tuple[jax.Array, jax.Array], _: None) -> tuple[Any, jax.Array]:
        sine, cosine = now
        found = sine * cosines + cosine * sines
        return (found[-1], cosine * cosines[-1] - sine * sines[-1]), found[:-1]

    _, found = jax.lax.scan(step, (jnp.sin(phase), jnp.cos(phase)), length=lifts.longest)
    return jnp.asarray(lifts.hand.tremor_amplitude * found)


def sensor_errors(key: jax.Array, senses: tuple[Sense, ...], steps: int, count: int) -> jax.Array:
    """Return the errors of a robot's senses (s, k, n); see :func:`.drawn_errors`.

    Senses whose errors have one role have the same ones, each in its own size.
    """
    roles = [each.role or each.name for each in senses if each.noise]
    drawn = normals(key, (steps, len({*roles}), count))
    places = {role: place for place, role in enumerate(dict.fromkeys(roles))}
    zero = jnp.zeros((steps, count))
    return jnp.stack(
        [
            each.noise * drawn[:, places[each.role or each.name]] if each.noise else zero
            for each in senses
        ],
        axis=1,
    )
