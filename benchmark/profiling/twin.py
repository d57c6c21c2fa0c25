"""The speed of the twin relative to the engine's, measured in one run."""

import statistics
import time
from concurrent.futures import ThreadPoolExecutor
from itertools import pairwise
from typing import Any, Final

import jax
import jax.numpy as jnp
import numpy as np
from colift.agents.policies.copy import Copy
from colift.benchmark.episode.lift import Lift
from colift.benchmark.episode.loop import run_episode
from colift.benchmark.suites.catalogue import make_scenario
from colift.benchmark.tasks.level.task import BEHAVIOURS, LEVEL
from colift.benchmark.twin.drawing import draw_lift, stack
from colift.benchmark.twin.lifts import Lifts, some
from colift.benchmark.twin.rollout import rollout
from colift.benchmark.twin.task_twin import TaskTwin

UNITS: Final = 64
"""Units of each of the two hidden layers of the network in the loop."""

THREADS: Final = 2
LIFTS: Final = 512
"""Lifts per thread in a rollout."""
GRADIENT_LIFTS: Final = 128
"""Lifts per thread in a gradient."""
STEPS: Final = 60
"""Steps of each lift: all are cut to the same length, so that none is counted at rest."""
DRAWN: Final = 64
ROUNDS: Final = 5
_SEED: Final = 211_000

Layers = list[tuple[jax.Array, jax.Array]]


def twin_speed() -> dict[str, float]:
    """Return the control steps per second of the twin relative to the engine's, with two threads.

    Returns
    -------
    dict
        ``twin_speed_ratio``: whole lifts with a network of two layers of :data:`UNITS` in the loop;
        ``twin_gradient_ratio``: whole lifts and their gradient in the network's weights. The engine
        plays ``copy``, whose own time is negligible, in one process. Medians of ratios.
    """
    pool = _drawn()
    layers = _layers()
    ratios: dict[str, list[float]] = {"twin_speed_ratio": [], "twin_gradient_ratio": []}
    lift = Lift(make_scenario("smooth", "S1"))
    measured = (
        ("twin_speed_ratio", jax.jit(_error), LIFTS),
        ("twin_gradient_ratio", jax.jit(jax.grad(_error)), GRADIENT_LIFTS),
    )
    with ThreadPoolExecutor(THREADS) as threads:
        for number in range(ROUNDS + 1):
            engine = _engine_speed(lift)
            for name, function, count in measured:
                lifts = some(pool, np.arange(count) % DRAWN)
                begin = time.perf_counter()
                started = [threads.submit(function, layers, lifts) for _ in range(THREADS)]
                for each in started:
                    _finished(each.result())
                taken = time.perf_counter() - begin
                if number:  # The first round compiles.
                    ratios[name].append(THREADS * count * STEPS / taken / engine)
    lift.close()
    return {name: statistics.median(found) for name, found in ratios.items()}


def _drawn() -> Lifts:
    scenarios = [
        make_scenario(BEHAVIOURS[i % len(BEHAVIOURS)], f"draw-{_SEED + i}") for i in range(DRAWN)
    ]
    longest = STEPS * scenarios[0].control_period
    drawn = [draw_lift(each, _SEED + i, longest=longest) for i, each in enumerate(scenarios)]
    return stack(drawn)._replace(steps=jnp.full(DRAWN, STEPS))


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


def _error(layers: Layers, lifts: Lifts) -> jax.Array:
    """Return the mean RMSE [mm] of lifts with a perceptron at the robot's end."""

    def policy(memory: None, view: jax.Array) -> tuple[None, jax.Array]:
        values = view
        for weight, bias in layers[:-1]:
            values = jnp.tanh(weight @ values + bias)
        weight, bias = layers[-1]
        return None, view[0] - view[3] + 0.02 * (weight @ values + bias)[0]

    return rollout(TaskTwin(LEVEL, LEVEL.person), policy, None, lifts).rmse_mm.mean()


def _engine_speed(lift: Lift) -> float:
    """Return the control steps per second of the engine."""
    steps = 0
    begin = time.perf_counter()
    for seed in range(10):
        steps += len(run_episode(lift, Copy(), seed).trace.human_end) // lift.frames_per_step
    return steps / (time.perf_counter() - begin)


def _finished(result: Any) -> None:
    for leaf in jax.tree.leaves(result):
        leaf.block_until_ready()
