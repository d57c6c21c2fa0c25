"""Proximal policy optimisation of one agent, from its inputs and rewards. Needs JAX.

The policy is moved by the clipped objective along estimated advantages (J. Schulman et al.,
"Proximal policy optimization algorithms", arXiv:1707.06347, and "High-dimensional continuous
control using generalized advantage estimation", ICLR 2016).
"""

from functools import partial
from typing import Any, NamedTuple

import jax
import jax.numpy as jnp
import numpy as np
import optax
from colift.benchmark.training.ppo_settings import PpoSettings
from colift.benchmark.training.result import Weights

Tree = Any
"""Arrays in named tuples and dictionaries."""


class Experience(NamedTuple):
    """Steps of lifts, each array with the axes (steps, lifts)."""

    inputs: jax.Array
    """(s, n, inputs) scaled."""
    action: jax.Array
    """Corrections before the tanh."""
    log_density: jax.Array
    """Logarithm of the density from which the action was drawn."""
    value: jax.Array
    """Estimated sum of the rewards to come."""
    reward: jax.Array
    valid: jax.Array
    """1 until the lift's horizon, then 0."""


class Learner(NamedTuple):
    """An agent that learns."""

    parameters: Tree
    """``policy`` and ``value``, two networks, and ``log_noise``."""
    memory: Tree
    """State of the optimiser."""


class Decision(NamedTuple):
    """A step of an agent in n lifts; all (n,)."""

    action: jax.Array
    """Correction before the tanh."""
    log_density: jax.Array
    value: jax.Array


def start(settings: PpoSettings, inputs: int, key: jax.Array) -> Tree:
    """Return the first parameters: the mean correction and the estimated value are 0."""
    keys, hidden = jax.random.split(key, 6), settings.hidden
    layer = jax.nn.initializers.orthogonal(2**0.5)

    def network(keys: jax.Array, last: float) -> Tree:
        out = jax.nn.initializers.orthogonal(last)
        return {
            "w0": layer(keys[0], (hidden, inputs)),
            "b0": jnp.zeros(hidden),
            "w1": layer(keys[1], (hidden, hidden)),
            "b1": jnp.zeros(hidden),
            "w2": out(keys[2], (1, hidden)),
            "b2": jnp.zeros(1),
            "linear": jnp.zeros(inputs),
        }

    return {
        "policy": network(keys[:3], 0.01),
        "value": network(keys[3:], 1.0),
        "log_noise": jnp.log(jnp.asarray(settings.noise)),
    }


def new_learner(settings: PpoSettings, inputs: int, key: jax.Array) -> Learner:
    """Return an agent that has not learned anything."""
    parameters = start(settings, inputs, key)
    return Learner(parameters, optimiser(settings).init(parameters))


def optimiser(settings: PpoSettings) -> optax.GradientTransformation:
    """Return Adam with a rate that falls linearly to zero, and bounded gradients."""
    falling = optax.linear_schedule(
        settings.rate, 0.0, settings.updates * settings.epochs * settings.batches
    )
    return optax.chain(optax.clip_by_global_norm(0.5), optax.adam(falling))


def weights(parameters: Tree) -> Weights:
    """Return the weights of the policy in NumPy."""
    return {name: np.asarray(value, np.float64) for name, value in parameters["policy"].items()}


def output(network: Tree, inputs: jax.Array) -> jax.Array:
    """Return the output (...) of a network for inputs (..., k)."""
    hidden = jnp.tanh(inputs @ network["w0"].T + network["b0"])
    hidden = jnp.tanh(hidden @ network["w1"].T + network["b1"])
    outputs = hidden @ network["w2"].T + network["b2"]
    found: jax.Array = outputs[..., 0] + inputs @ network["linear"]
    return found


def decide(parameters: Tree, inputs: jax.Array, drawn: jax.Array) -> Decision:
    """Return the actions for inputs (..., k), with standard normal noise ``drawn`` (...)."""
    log_noise = parameters["log_noise"]
    return Decision(
        action=output(parameters["policy"], inputs) + jnp.exp(log_noise) * drawn,
        log_density=_log_density(drawn, log_noise),
        value=output(parameters["value"], inputs),
    )


def advantages(settings: PpoSettings, played: Experience) -> jax.Array:
    """Return the generalised estimate of each action's advantage (s, n); 0 after the horizon."""

    def back(
        after: tuple[jax.Array, jax.Array], now: tuple[jax.Array, ...]
    ) -> tuple[tuple[jax.Array, jax.Array], jax.Array]:
        coming, next_value = after
        reward, value, valid = now
        surprise = reward + settings.discount * next_value - value
        advantage = valid * (surprise + settings.discount * settings.trace * coming)
        return (advantage, valid * value), advantage

    zero = jnp.zeros(played.value.shape[1])
    steps = (played.reward, played.value, played.valid)
    return jax.lax.scan(back, (zero, zero), steps, reverse=True)[1]


def objective(
    settings: PpoSettings,
    parameters: Tree,
    played: Experience,
    advantage: jax.Array,
    aim: jax.Array,
) -> jax.Array:
    """Return the clipped objective with the error of the values, to be minimised."""
    drawn = played.action - output(parameters["policy"], played.inputs)
    drawn = drawn / jnp.exp(parameters["log_noise"])
    ratio = jnp.exp(_log_density(drawn, parameters["log_noise"]) - played.log_density)
    clipped = jnp.clip(ratio, 1 - settings.clip, 1 + settings.clip)
    gain = jnp.minimum(ratio * advantage, clipped * advantage)
    miss = (output(parameters["value"], played.inputs) - aim) ** 2
    return ((0.5 * 0.1 * miss - gain) * played.valid).sum() / played.valid.sum()


def learn(settings: PpoSettings, learner: Learner, played: Experience, key: jax.Array) -> Learner:
    """Return the agent after some passes through its experience, in an order drawn by the key."""
    advantage = advantages(settings, played)
    aim = advantage + played.value
    total = played.valid.sum()
    mean = (advantage * played.valid).sum() / total
    spread = jnp.sqrt((((advantage - mean) ** 2) * played.valid).sum() / total)
    advantage = (advantage - mean) / (spread + 1e-8)
    samples = (played, advantage, aim)
    size = advantage.size // settings.batches
    flat = jax.tree.map(lambda array: array.reshape(-1, *array.shape[2:]), samples)

    def step(learner: Learner, chosen: jax.Array) -> tuple[Learner, None]:
        batch = jax.tree.map(lambda array: array[chosen], flat)
        slope = jax.grad(partial(objective, settings))(learner.parameters, *batch)
        changes, memory = optimiser(settings).update(slope, learner.memory, learner.parameters)
        return Learner(optax.apply_updates(learner.parameters, changes), memory), None

    def epoch(learner: Learner, key: jax.Array) -> tuple[Learner, None]:
        shuffled = jax.random.permutation(key, advantage.size)[: size * settings.batches]
        return jax.lax.scan(step, learner, shuffled.reshape(settings.batches, size))[0], None

    return jax.lax.scan(epoch, learner, jax.random.split(key, settings.epochs))[0]


def _log_density(drawn: jax.Array, log_noise: jax.Array) -> jax.Array:
    """Return the logarithm of a normal density, up to a constant; ``drawn`` is standardised."""
    return -0.5 * drawn**2 - log_noise
