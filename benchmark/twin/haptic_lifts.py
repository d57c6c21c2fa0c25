"""Drawn arrays of all tasks with touch: sensors, the noise of a hand, and stacked lifts."""

from collections.abc import Sequence
from typing import NamedTuple

import jax
import jax.numpy as jnp
import numpy as np
from colift.agents.errors import InputError
from colift.agents.humans import Subject
from colift.agents.humans.hand import drawn_noise
from colift.benchmark.episode.lift import MOCAP_NOISE
from colift.benchmark.episode.scenario import Scenario
from colift.benchmark.episode.seat import body_parameters
from colift.benchmark.episode.seeding import derive_seed
from colift.benchmark.tasks.haptic import FINER, FORCE_NOISE, TORQUE_NOISE
from colift.benchmark.twin.body import Body, bodies
from colift.benchmark.world.world import HISTORY_FRAMES
from numpy.typing import NDArray

Array = NDArray[np.float64]


class Sensed(NamedTuple):
    """The drawn arrays common to all tasks with touch, for s steps of f frames."""

    gain: Array
    """(s, f) signal-dependent noise of the person's hand, relative to its velocity."""
    tremor: Array
    """(s, f) tremor of the hand [m]."""
    noise: Array
    """(s, 4) error of the motion capture at either end [m], of force [N] and torque [Nm]."""


def draw_sensed(scenario: Scenario, seed: int, steps: int) -> Sensed:
    """Return the noise of sensors and hand in a lift of ``steps`` steps."""
    name, size = scenario.name, scenario.frames_per_step
    frames = steps * size
    rng = np.random.default_rng(derive_seed(seed, f"sensor/{name}"))
    mocap = rng.normal(0.0, MOCAP_NOISE, (2, HISTORY_FRAMES + frames))
    rng = np.random.default_rng(derive_seed(seed, f"force sensor/{name}"))
    touch = rng.normal(0.0, 1.0, (2, steps + 1))[:, :steps]
    touch = touch * np.array([[FORCE_NOISE], [TORQUE_NOISE]])
    person = scenario.subject
    gain, tremor = drawn_noise(person, derive_seed(seed, f"human/{name}"), frames)
    return Sensed(
        gain.reshape(steps, size),
        tremor.reshape(steps, size),
        np.concatenate((mocap[:, sampled_frames(scenario, steps)], touch)).T,
    )


def sampled_frames(scenario: Scenario, steps: int) -> NDArray[np.int64]:
    """Return the indices of the steps' samples in a lift's motion-capture noise (s,)."""
    size = scenario.frames_per_step
    return size * np.arange(steps) + HISTORY_FRAMES - 1 - scenario.latency_frames


def lengthened(values: Array, frames: int) -> Array:
    """Return values (T,), with the last one repeated up to ``frames`` values."""
    return np.concatenate((values, np.full(frames - len(values), values[-1])))


def joined(arrays: Sequence[Array], many: int) -> jax.Array:
    """Return arrays as one (many, ..., n), in single precision; shorter ones repeat their end."""
    filled = np.empty((many, *arrays[0].shape[1:], len(arrays)), np.float32)
    for index, array in enumerate(arrays):
        filled[: len(array), ..., index] = array
        filled[len(array) :, ..., index] = array[-1]
    return jnp.asarray(filled)


def common_size(sizes: Sequence[int]) -> int:
    """Return the frames of a step, which all lifts must have in common.

    Raises
    ------
    InputError
        If there is no lift, or there are different control periods.
    """
    if len(set(sizes)) != 1:
        raise InputError(f"the twin needs lifts of one control period, got {len(set(sizes))}")
    return sizes[0]


def bodies_in_touch(people: Sequence[Subject]) -> Body:
    """Return the bodies of people as arrays, for the physics steps of the tasks with touch."""
    return bodies([body_parameters(person) for person in people], FINER.step)
