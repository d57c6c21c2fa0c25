"""The speed of the twin, by the number of lifts at a time, and relative to the engine's."""

import time
from collections.abc import Callable, Sequence
from itertools import pairwise
from typing import Any, Final, NamedTuple

import jax
import jax.numpy as jnp
import numpy as np
from colift.agents.policies.copy import Copy
from colift.benchmark.episode.lift import Lift
from colift.benchmark.episode.loop import run_episode
from colift.benchmark.episode.scenario import CONTROL_PERIOD
from colift.benchmark.suites.catalogue import make_scenario
from colift.benchmark.tasks.level.task import BEHAVIOURS, LEVEL
from colift.benchmark.twin.bulk import many_lifts
from colift.benchmark.twin.drawing import DrawnLift, draw_lift, stack
from colift.benchmark.twin.lifts import Lifts, some
from colift.benchmark.twin.rollout import rollout
from colift.benchmark.twin.task_twin import TaskTwin
from colift.benchmark.twin_environment.environment import ROBOT, TwinEnv
from colift.benchmark.twin_environment.pool import LiftPool

UNITS: Final = 64
"""Units of each of the two hidden layers of the network in the loop."""

BATCHES: Final = {"cpu": (1, 64, 512, 4096), "gpu": (1, 512, 4096, 32_768, 131_072)}
"""Lifts at a time, by device."""

STEPS: Final = 60
"""Steps of each lift: all are cut to the same length, so that none is counted at rest."""

DRAWN: Final = 64
MANY: Final = 4096
"""Lifts drawn in bulk."""

ROUNDS: Final = 5
_SEED: Final = 211_000

Layers = list[tuple[jax.Array, jax.Array]]


class TwinSpeed(NamedTuple):
    """Control steps per second with some lifts at a time, medians of rounds."""

    lifts: int
    whole: float
    """Whole lifts with a network of two layers of :data:`UNITS` in the loop."""
    gradient: float
    """Whole lifts, and their gradient in the network's weights."""
    environment: float
    """Single steps of the environment with the network, with automatic reset."""


def twin_speeds(
    progress: Callable[[int], None] = lambda many: None,
) -> tuple[list[TwinSpeed], dict[str, float]]:
    """Return the speed by the number of lifts, and ratios to the engine's, measured in turn.

    Returns
    -------
    list
        The speed of each batch of :data:`BATCHES`, on the device that JAX uses.
    dict
        ``twin_speed_ratio``, ``twin_gradient_ratio`` and ``twin_environment_ratio``: the largest
        over the engine's control steps per second, which plays ``copy`` in one process.
        ``twin_bulk_ratio``: the speed of :func:`.many_lifts` over that of drawing one by one.
    """
    pool, layers = _drawn(), _layers()
    lift = Lift(make_scenario("smooth", "S1"))
    found, engine = [], []
    for count in BATCHES[jax.default_backend()]:
        ways = _ways(pool, layers, count)
        rates: list[list[float]] = [[] for _ in ways]
        for play in ways:
            play()  # It compiles.
        for _ in range(ROUNDS):
            engine.append(_engine_speed(lift))
            for rate, play in zip(rates, ways, strict=True):
                begin = time.perf_counter()
                jax.device_get(play())
                rate.append(count * STEPS / (time.perf_counter() - begin))
        found.append(TwinSpeed(count, *(float(np.median(each)) for each in rates)))
        progress(1)
    lift.close()
    base = float(np.median(engine))
    ratios = {
        f"twin_{name}_ratio": max(getattr(each, field) for each in found) / base
        for name, field in (
            ("speed", "whole"),
            ("gradient", "gradient"),
            ("environment", "environment"),
        )
    }
    return found, {**ratios, "twin_bulk_ratio": _bulk_ratio()}


def _bulk_ratio() -> float:
    """Return the speed of drawing whole lifts in bulk over that of drawing them one by one."""
    twin, lifts = TaskTwin(LEVEL, LEVEL.person), stack(_whole_lifts())
    ratios = []
    for draw in range(ROUNDS + 1):  # The first time it compiles.
        begin = time.perf_counter()
        stack(_whole_lifts())
        one = time.perf_counter()
        jax.device_get(many_lifts(twin, lifts, MANY, jax.random.key(draw)).stop)
        ratios.append((one - begin) / DRAWN / ((time.perf_counter() - one) / MANY))
    return float(np.median(ratios[1:]))


def _ways(pool: Lifts, layers: Layers, count: int) -> Sequence[Callable[[], Any]]:
    """Return functions that play some lifts: whole, with the gradient, and step by step."""
    lifts = some(pool, np.arange(count) % DRAWN)
    whole, gradient = jax.jit(_error), jax.jit(jax.grad(_error))
    env = TwinEnv(TaskTwin(LEVEL, LEVEL.person), LiftPool(pool))

    @jax.jit
    def steps(layers: Layers, key: jax.Array) -> jax.Array:
        def step(now: Any, key: jax.Array) -> Any:
            views, states = now
            actions = {ROBOT: _moved(layers, views[ROBOT].T)[:, jnp.newaxis]}
            keys = jax.random.split(key, count)
            views, states, rewards, _, _ = jax.vmap(env.step)(keys, states, actions)
            return (views, states), rewards[ROBOT].sum()

        begun = jax.vmap(env.reset)(jax.random.split(key, count))
        _, rewards = jax.lax.scan(step, begun, jax.random.split(key, STEPS))
        return jnp.asarray(rewards)

    return (
        lambda: whole(layers, lifts),
        lambda: gradient(layers, lifts),
        lambda: steps(layers, jax.random.key(0)),
    )


def _drawn() -> Lifts:
    return stack(_whole_lifts(STEPS * CONTROL_PERIOD))._replace(steps=jnp.full(DRAWN, STEPS))


def _whole_lifts(longest: float | None = None) -> list[DrawnLift]:
    scenarios = [
        make_scenario(BEHAVIOURS[i % len(BEHAVIOURS)], f"draw-{_SEED + i}") for i in range(DRAWN)
    ]
    return [draw_lift(each, _SEED + i, longest=longest) for i, each in enumerate(scenarios)]


def _layers() -> Layers:
    rng = np.random.default_rng(0)
    sizes = (5, UNITS, UNITS, 1)
    return [
        (
            jnp.asarray(rng.standard_normal((out, into)) / np.sqrt(into), jnp.float32),
            jnp.zeros((out, 1)),
        )
        for into, out in pairwise(sizes)
    ]


def _moved(layers: Layers, view: jax.Array) -> jax.Array:
    """Return the actions (n,) of a perceptron for views (k, n)."""
    values = view
    for weight, bias in layers[:-1]:
        values = jnp.tanh(weight @ values + bias)
    weight, bias = layers[-1]
    return view[0] - view[3] + 0.02 * (weight @ values + bias)[0]


def _error(layers: Layers, lifts: Lifts) -> jax.Array:
    """Return the mean RMSE [mm] of lifts with a perceptron at the robot's end."""

    def policy(memory: None, view: jax.Array) -> tuple[None, jax.Array]:
        return None, _moved(layers, view)

    return rollout(TaskTwin(LEVEL, LEVEL.person), policy, None, lifts).rmse_mm.mean()


def _engine_speed(lift: Lift) -> float:
    """Return the control steps per second of the engine."""
    steps = 0
    begin = time.perf_counter()
    for seed in range(10):
        steps += len(run_episode(lift, Copy(), seed).trace.human_end) // lift.frames_per_step
    return steps / (time.perf_counter() - begin)
