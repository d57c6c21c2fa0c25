"""The lifts on which gradients are taken: drawn people, some with habits from wide ranges."""

import dataclasses
import math
from collections.abc import Sequence
from typing import Final, NamedTuple

import jax
import jax.numpy as jnp
import numpy as np
from colift.agents.agent import FRAME, RobotObservation
from colift.agents.control.recurrent import STEPS_AHEAD
from colift.agents.humans import Subject
from colift.agents.humans.subject import BOUNDS
from colift.agents.senses import MOCAP_NOISE
from colift.benchmark.episode.scenario import CONTROL_PERIOD, LATENCY, Scenario
from colift.benchmark.episode.seeding import derive_seed
from colift.benchmark.tasks.level.task import LEVEL
from colift.benchmark.training.anticipation import FIRST_SEED
from colift.benchmark.training.apg_settings import ApgSettings
from colift.benchmark.training.data import Timing, scenario
from colift.benchmark.training.lesson import BatchDraw
from colift.benchmark.training.population import curriculum
from colift.benchmark.training.sensing import with_losses, with_noise, with_own_errors
from colift.benchmark.training.validation import learning_seeds
from colift.benchmark.training.wandering import Wandering
from colift.benchmark.twin.arm import ArmVariation
from colift.benchmark.twin.drawing import draw_lift, stack
from colift.benchmark.twin.lifts import Lifts, some
from colift.benchmark.twin.rollout import rollout
from colift.benchmark.twin.task_twin import TaskTwin

TWIN: Final = TaskTwin(LEVEL, LEVEL.person)
"""The twin of the task ``level``."""

LONGEST: Final = 12.0
"""Time after which a lift is cut off [s]: four of five end earlier."""

WANDERING: Final = "wandering"
"""Name of the behaviour :class:`.Wandering`, which is in no registry."""

WANDERERS: Final = 0.2
"""Share of the wide lifts with a wanderer."""

LATENCY_OFF: Final = 0.01
"""Largest deviation of a wide lift's latency from the benchmark's [s]."""

NOISE: Final = (0.1, 2.0)
"""Least and largest additional noise of their samples, relative to that of the benchmark."""

LOST: Final = 0.05
"""Largest share of their samples that are lost."""

TYPICAL: Final = 6.0
"""Error of a straight line at which a wide lift has the weight 1 [mm]."""

MOST_WEIGHT: Final = 4.0
"""Largest weight of a lift, and the inverse of the smallest."""

CHUNK: Final = 1000
"""Most lifts whose weights are computed at once."""


class Pool(NamedTuple):
    """Drawn lifts, the common ones first."""

    lifts: Lifts
    common: int
    """Number of lifts with people of the benchmark's population."""
    weight: jax.Array
    """(n,) weight of each lift in the loss."""


def draw_pool(count: int, wide: float, unsettled: int = 0, first_seed: int = FIRST_SEED) -> Pool:
    """Return lifts to learn from.

    Parameters
    ----------
    count
        Number of lifts.
    wide
        Share of the lifts whose people have wide habits, bodies and sensors.
    unsettled
        Lifts with an unsettled hand for every five others; see :func:`.curriculum`.
    first_seed
        Seed of the first lift.

    Raises
    ------
    InputError
        If there are fewer than 2, or a seed is not for learning.
    """
    seeds = learning_seeds(count, first_seed)
    common = count - round(wide * count)
    ways = curriculum(unsettled)
    scenarios = [scenario(seed, ways, Timing()) for seed in seeds[:common]]
    scenarios += [_wide(seed, ways) for seed in seeds[common:]]
    drawn = zip(scenarios, seeds, strict=True)
    lifts = stack([draw_lift(each, seed, longest=LONGEST) for each, seed in drawn])
    return Pool(lifts, common, _weights(lifts, common))


def _weights(lifts: Lifts, common: int) -> jax.Array:
    """Return the weights of lifts: 1, and for wide ones by their difficulty for a straight line.

    Their errors differ by an order of magnitude. Without weights, a few quick lifts would dominate
    the learning, and the slow ones, which are frequent when people lift together, would not count.
    """

    @jax.jit
    def line_mm(some_lifts: Lifts) -> jax.Array:
        return rollout(TWIN, straight_line, jnp.zeros(some_lifts.size), some_lifts).rmse_mm

    parts = np.array_split(np.arange(lifts.size), -(-lifts.size // CHUNK))
    errors = jnp.concatenate([line_mm(some(lifts, part)) for part in parts])
    weight = jnp.clip(TYPICAL / errors, 1 / MOST_WEIGHT, MOST_WEIGHT)
    return jnp.where(jnp.arange(lifts.size) < common, 1.0, weight)


def straight_line(last: jax.Array, view: jax.Array) -> tuple[jax.Array, jax.Array]:
    """Return the newest height, and the action of :class:`.Extrapolate`."""
    height = view[RobotObservation.HUMAN_END]
    rise = jnp.where(view[RobotObservation.TIME] > 0, height - last, 0.0)
    return height, height + STEPS_AHEAD * rise - view[RobotObservation.HAND_COMMAND]


def _wide(seed: int, ways: Sequence[str]) -> Scenario:
    """Return a lift with a widely drawn person and latency, in some a wanderer."""
    rng = np.random.default_rng(derive_seed(seed, "wide"))
    off = round(LATENCY_OFF / FRAME)
    latency = round(LATENCY / FRAME) + int(rng.integers(-off, off + 1))
    timing = Timing(latency=latency * FRAME, control_period=CONTROL_PERIOD)
    known = scenario(seed, ways, timing)
    person = _wide_person(known.subject, rng)
    if rng.random() >= WANDERERS:
        return dataclasses.replace(known, subject=person)
    return dataclasses.replace(known, behaviour=WANDERING, human=Wandering(), subject=person)


def _wide_person(person: Subject, rng: np.random.Generator) -> Subject:
    """Return the person with habits and a body from wide ranges, slow lifts as often as quick."""

    def even(low: float, high: float) -> float:
        return math.exp(rng.uniform(math.log(low), math.log(high)))

    fewest = int(rng.integers(0, 3))
    stiffness = even(100.0, 800.0)
    mass = even(0.5, 2.0)
    ratio = rng.uniform(0.5, 1.1)
    damping = min(max(2 * ratio * math.sqrt(stiffness * mass), 5.0), 30.0)
    return dataclasses.replace(
        person,
        amplitude=rng.uniform(*BOUNDS["amplitude"]),
        amplitude_spread=rng.uniform(0.1, 0.5),
        duration=even(*BOUNDS["duration"]),
        duration_spread=rng.uniform(0.0, 0.3),
        lowering_ratio=rng.uniform(*BOUNDS["lowering_ratio"]),
        skew_up=rng.uniform(*BOUNDS["skew_up"]),
        skew_down=rng.uniform(*BOUNDS["skew_down"]),
        submovements=(fewest, fewest + int(rng.integers(0, 3))),
        stiffness=stiffness,
        mass=mass,
        damping=damping,
        pull=rng.uniform(0.0, 0.5),
        felt_share=rng.random(),
        motor_noise=rng.uniform(0.0, 0.1),
        tremor_amplitude=even(2e-5, 6e-4),
    )


class LearningBatch(NamedTuple):
    """Lifts to learn from, with their differences from the benchmark."""

    lifts: Lifts
    weight: jax.Array
    """(n,) weight of each lift in the loss."""
    common: jax.Array
    """(n,) 1 with people of the benchmark's population, else 0."""


def draw_batch(pool: Pool, settings: ApgSettings, draw: BatchDraw) -> LearningBatch:
    """Return a batch of the pool's lifts, with arms and the noise of sensors drawn anew.

    A lift recurs many times in a training, and a network would memorise whatever is always the same
    in it.

    Parameters
    ----------
    pool
        The lifts.
    settings
        Settings of the training. The share ``wide`` of the lifts has wide habits and wide sensors.
    draw
        Draw of the batch.
    """
    size, keys = draw.size, jax.random.split(draw.key, 9)
    many = round(settings.wide * size)
    common, total = pool.common, pool.lifts.size
    taken = jax.random.randint(keys[0], (size - many,), 0, common)
    rest = jax.random.randint(keys[1], (many,), common, jnp.maximum(total, common + 1))
    chosen = jnp.concatenate((taken, rest))
    lifts = some(pool.lifts, chosen)._replace(arms=draw_arms(draw.varied, size, keys[2:4]))
    is_wide = (jnp.arange(size) >= size - many).astype(jnp.float32)
    low, high = (math.log(factor) for factor in NOISE)
    more = is_wide * jnp.exp(jax.random.uniform(keys[4], (size,), minval=low, maxval=high))
    lifts = with_noise(lifts, MOCAP_NOISE * jnp.sqrt(1 + more**2), keys[5])
    chance = LOST * is_wide * jax.random.uniform(keys[6], (size,))
    lifts = with_losses(lifts, chance, keys[7])
    return LearningBatch(
        lifts=with_own_errors(lifts, settings.encoders, keys[8]),
        weight=pool.weight[chosen],
        common=1.0 - is_wide,
    )


def draw_arms(varied: jax.Array, size: int, keys: jax.Array) -> ArmVariation:
    """Return arms whose sag and gain are the benchmark's times exp(varied N(0, 1)).

    Parameters
    ----------
    varied
        Standard deviation of the logarithms.
    size
        Number of arms.
    keys
        (2,) random keys of the sag and of the gain.
    """
    sag, lag = (jnp.exp(varied * jax.random.normal(key, (size,))) for key in keys)
    return ArmVariation(sag=sag, lag=lag)
