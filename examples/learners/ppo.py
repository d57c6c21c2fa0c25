"""Proximal policy optimisation of the robot, on the twin, in one compiled function.

After Schulman et al. 2017 (arXiv 1707.06347), in the manner of PureJaxRL: environment, collection
and updates are one ``jax.lax.scan``. It needs the extra ``train``::

    python examples/learners/ppo.py --task level --out ppo
    colift run ppo
"""

import argparse
import math
import time
from pathlib import Path
from typing import NamedTuple

import colift.twin
import jax
import jax.numpy as jnp
import optax
from colift.base.errors import InputError

ENVS = 512  # Lifts at a time.
LENGTH = 64  # Steps of each between two updates.
EPOCHS, PARTS = 4, 8  # Passes over what was collected, and parts of each pass.
UNITS = 64  # Tanh units of each of two layers.
RATE, NORM = 1e-3, 0.5  # Learning rate, falling to 0, and largest norm of a gradient.
DISCOUNT, TRACE, CLIP, VALUE = 0.95, 0.9, 0.2, 0.5
SPREAD = -1.0  # Logarithm of the standard deviation of the first actions.


class Moment(NamedTuple):
    """A step of the collection, for all lifts."""

    seen: jax.Array
    action: jax.Array
    chance: jax.Array  # Logarithm of the action's probability density.
    value: jax.Array
    reward: jax.Array
    done: jax.Array
    score_mm: jax.Array  # Of the lifts that have just ended, else 0.


def perceptron(key, inputs, gain):
    """Return the weights of two layers of tanh units, and of one output of the size ``gain``."""
    sizes, weights = (inputs, UNITS, UNITS, 1), {}
    for i, each in enumerate(jax.random.split(key, 3)):
        size = 2**0.5 if i < 2 else gain
        shape = (sizes[i + 1], sizes[i])
        weights[f"w{i}"] = jax.nn.initializers.orthogonal(size)(each, shape)
        weights[f"b{i}"] = jnp.zeros(sizes[i + 1])
    return weights


def output(weights, seen):
    """Return the output (n,) for observations (n, k)."""
    for i in range(2):
        seen = jnp.tanh(seen @ weights[f"w{i}"].T + weights[f"b{i}"])
    return (seen @ weights["w2"].T + weights["b2"])[..., 0]


def log_chance(learner, seen, action):
    """Return the logarithm of the density of actions: normal about the network's."""
    deviation = (action - jnp.tanh(output(learner["actor"], seen))) / jnp.exp(learner["spread"])
    return -0.5 * deviation**2 - learner["spread"] - 0.5 * jnp.log(2 * jnp.pi)


def make_train(env, updates):
    """Return the function that trains from a key: weights, and the mean score of each update."""
    inputs = env.observation_space().shape[0]
    falling = optax.linear_schedule(RATE, 0.0, updates * EPOCHS * PARTS)
    optimiser = optax.chain(optax.clip_by_global_norm(NORM), optax.adam(falling, eps=1e-5))

    def collect(learner, lifts, key):
        """Play some steps of all lifts."""

        def step(now, key):
            seen, state = now
            noise, draw = jax.random.split(key)
            mean = jnp.tanh(output(learner["actor"], seen))
            action = mean + jnp.exp(learner["spread"]) * jax.random.normal(noise, mean.shape)
            keys = jax.random.split(draw, ENVS)
            after, state, reward, done, info = jax.vmap(env.step)(keys, state, action[:, None])
            chance, value = log_chance(learner, seen, action), output(learner["critic"], seen)
            moment = Moment(seen, action, chance, value, reward, done, info["score_mm"])
            return (after, state), moment

        return jax.lax.scan(step, lifts, jax.random.split(key, LENGTH))

    def advantages(moments, last):
        """Return the generalised advantage estimates (Schulman et al. 2016)."""

        def back(after, moment):
            gain, value = after
            goes_on = 1.0 - moment.done
            surprise = moment.reward + DISCOUNT * goes_on * value - moment.value
            gain = surprise + DISCOUNT * TRACE * goes_on * gain
            return (gain, moment.value), gain

        return jax.lax.scan(back, (jnp.zeros(ENVS), last), moments, reverse=True)[1]

    def loss(learner, moment, advantage, aim):
        """Return the clipped objective, and the error of the values."""
        advantage = (advantage - advantage.mean()) / (advantage.std() + 1e-8)
        ratio = jnp.exp(log_chance(learner, moment.seen, moment.action) - moment.chance)
        gain = jnp.minimum(ratio * advantage, jnp.clip(ratio, 1 - CLIP, 1 + CLIP) * advantage)
        error = (output(learner["critic"], moment.seen) - aim) ** 2
        return VALUE * error.mean() - gain.mean()

    def update(now, key):
        """Collect, and improve the networks."""
        learner, momentum, lifts = now
        play, mix = jax.random.split(key)
        lifts, moments = collect(learner, lifts, play)
        advantage = advantages(moments, output(learner["critic"], lifts[0]))
        data = (moments, advantage, advantage + moments.value)
        flat = jax.tree.map(lambda each: each.reshape(ENVS * LENGTH, *each.shape[2:]), data)

        def improve(held, part):
            learner, momentum = held
            gradient = jax.grad(loss)(learner, *part)
            change, momentum = optimiser.update(gradient, momentum)
            return (optax.apply_updates(learner, change), momentum), None

        def epoch(held, key):
            order = jax.random.permutation(key, ENVS * LENGTH).reshape(PARTS, -1)
            return jax.lax.scan(improve, held, jax.tree.map(lambda each: each[order], flat))

        held, _ = jax.lax.scan(epoch, (learner, momentum), jax.random.split(mix, EPOCHS))
        ended = moments.done.sum()
        score = jnp.where(ended, moments.score_mm.sum() / jnp.maximum(ended, 1), jnp.nan)
        return (*held, lifts), score

    @jax.jit
    def train(key):
        actor, critic, begin, learn = jax.random.split(key, 4)
        learner = {
            "actor": perceptron(actor, inputs, 0.01),
            "critic": perceptron(critic, inputs, 1.0),
            "spread": jnp.asarray(SPREAD),
        }
        lifts = jax.vmap(env.reset)(jax.random.split(begin, ENVS))
        start = (learner, optimiser.init(learner), lifts)
        (learner, *_), scores = jax.lax.scan(update, start, jax.random.split(learn, updates))
        return learner["actor"], scores

    return train


def main():
    """Train, and write the submission."""
    arguments = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    arguments.add_argument("--task", default="level", help="level, agree, ball, intent, ...")
    arguments.add_argument("--steps", type=float, default=5e6, help="control steps")
    arguments.add_argument("--seed", type=int, default=0)
    arguments.add_argument("--out", type=Path, required=True, help="folder of the submission")
    given = arguments.parse_args()

    least = ENVS * LENGTH  # One update.
    if not least <= given.steps < math.inf:
        raise InputError(f"--steps must be finite, and {least} or more; got {given.steps:g}")
    colift.twin.TrainingView.check_folder(given.out)
    updates = round(given.steps / least)
    view = colift.twin.TrainingView(colift.twin.make(given.task, seed=given.seed))
    begin = time.perf_counter()
    train = make_train(colift.twin.Single(view), updates)
    actor, scores = jax.block_until_ready(train(jax.random.key(given.seed)))
    taken = time.perf_counter() - begin
    for place in range(0, updates, max(updates // 10, 1)):
        print(f"{(place + 1) * ENVS * LENGTH:10,} steps  {scores[place]:7.2f} mm")
    trained_on = f"{updates * ENVS * LENGTH:,} steps of the twin with drawn people."
    folder = view.write(given.out, actor, name=f"ppo seed {given.seed}", trained_on=trained_on)
    print(f"{scores[-1]:.2f} mm with noise, {taken:.0f} s: {folder}")


if __name__ == "__main__":
    try:
        main()
    except InputError as error:
        raise SystemExit(f"error: {error}") from None
