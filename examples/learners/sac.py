"""Soft actor-critic of the robot, on the twin, in one compiled function.

After Haarnoja et al. 2018 (arXiv 1812.05905): off-policy, with two critics, their slow copies, and
a temperature that keeps the entropy of the actions. It needs the extra ``train``::

    python examples/learners/sac.py --task level --out sac
    colift run sac
"""

import argparse
import math
import time
from functools import partial
from pathlib import Path
from typing import NamedTuple

import colift.twin
import jax
import jax.numpy as jnp
import optax
from colift.base.errors import InputError

ENVS = 128  # Lifts at a time.
KEPT = 2048  # Steps of each that are kept to learn from: 260,000 in all.
FIRST = 128  # Steps of each before anything is learned.
BATCH, PASSES = 512, 4  # Steps of a batch, and batches for each step of all lifts.
UNITS = 64  # Tanh units of each of two layers.
RATE, NORM = 1e-3, 10.0  # Learning rate, and largest norm of a gradient.
DISCOUNT, SLOW = 0.95, 0.005  # Weight of a step later, and pace of the slow copies.
ENTROPY = -1.0  # The entropy that the temperature keeps: one action.
NARROW, WIDE = -5.0, 0.0  # Range of the logarithm of the actions' standard deviation.


class Moment(NamedTuple):
    """Steps that were played."""

    seen: jax.Array
    action: jax.Array
    reward: jax.Array
    later: jax.Array
    done: jax.Array


class Learner(NamedTuple):
    """The networks: of actions, of values, their slow copies, and the temperature's logarithm."""

    actor: dict
    critics: dict
    slow: dict
    heat: jax.Array


def perceptron(key, inputs, outputs, gain):
    """Return the weights of two layers of tanh units, and of outputs of the size ``gain``."""
    sizes, weights = (inputs, UNITS, UNITS, outputs), {}
    for i, each in enumerate(jax.random.split(key, 3)):
        size = 2**0.5 if i < 2 else gain
        shape = (sizes[i + 1], sizes[i])
        weights[f"w{i}"] = jax.nn.initializers.orthogonal(size)(each, shape)
        weights[f"b{i}"] = jnp.zeros(sizes[i + 1])
    return weights


def output(weights, seen):
    """Return the outputs (n, m) for observations (n, k)."""
    for i in range(2):
        seen = jnp.tanh(seen @ weights[f"w{i}"].T + weights[f"b{i}"])
    return seen @ weights["w2"].T + weights["b2"]


def drawn(actor, seen, key):
    """Return actions (n,), and the logarithm of their density: the tanh of normal numbers."""
    mean, spread = jnp.moveaxis(output(actor, seen), -1, 0)
    spread = NARROW + 0.5 * (WIDE - NARROW) * (jnp.tanh(spread) + 1.0)
    normal = jax.random.normal(key, mean.shape)
    raw = mean + jnp.exp(spread) * normal
    chance = -0.5 * normal**2 - spread - 0.5 * jnp.log(2 * jnp.pi)
    squashing = 2.0 * (jnp.log(2.0) - raw - jax.nn.softplus(-2.0 * raw))
    return jnp.tanh(raw), chance - squashing


def values(critics, seen, action):
    """Return the values of both critics (2, n)."""
    both = jnp.concatenate((seen, action[..., None]), axis=-1)
    return jax.vmap(output, in_axes=(0, None))(critics, both)[..., 0]


def make_train(env, rounds):
    """Return the function that trains from a key: the actor, and the score of each round."""
    inputs = env.observation_space().shape[0]
    optimiser = optax.chain(optax.clip_by_global_norm(NORM), optax.adam(RATE))

    def loss(learner, moment, key):
        """Return the sum of the three losses, each of which moves its own network alone."""
        fixed, heat = jax.lax.stop_gradient(learner), jnp.exp(learner.heat)
        now, then = jax.random.split(key)
        next_action, next_chance = drawn(fixed.actor, moment.later, then)
        best = values(fixed.slow, moment.later, next_action).min(axis=0)
        soft = best - jnp.exp(fixed.heat) * next_chance
        aim = moment.reward + DISCOUNT * (1.0 - moment.done) * soft
        off = ((values(learner.critics, moment.seen, moment.action) - aim) ** 2).mean()
        action, chance = drawn(learner.actor, moment.seen, now)
        gain = values(fixed.critics, moment.seen, action).min(axis=0)
        gain -= jnp.exp(fixed.heat) * chance
        warm = heat * jax.lax.stop_gradient(-chance - ENTROPY)
        return off - gain.mean() + warm.mean()

    def improve(kept, filled, held, key):
        """Return the learner after a batch of what is kept."""
        learner, momentum = held
        when, who, draw = jax.random.split(key, 3)
        chosen = (
            jax.random.randint(when, (BATCH,), 0, filled),
            jax.random.randint(who, (BATCH,), 0, ENVS),
        )
        gradient = jax.grad(loss)(learner, jax.tree.map(lambda each: each[chosen], kept), draw)
        change, momentum = optimiser.update(gradient, momentum)
        learner = optax.apply_updates(learner, change)
        slow = optax.incremental_update(learner.critics, learner.slow, SLOW)
        return (learner._replace(slow=slow), momentum), None

    def round_of(now, step):
        """Play a step of all lifts, and learn from some batches."""
        held, lifts, kept, key = now
        key, act, play, learn = jax.random.split(key, 4)
        seen, state = lifts
        action, _ = drawn(held[0].actor, seen, act)
        keys = jax.random.split(play, ENVS)
        later, state, reward, done, info = jax.vmap(env.step)(keys, state, action[:, None])
        # A lift ends by its time: it has no value later.
        moment = Moment(seen, action, reward, later, done.astype(float))
        kept = jax.tree.map(lambda every, new: every.at[step % KEPT].set(new), kept, moment)
        filled = jnp.minimum(step + 1, KEPT)
        passes = jax.random.split(learn, PASSES)
        held = jax.lax.cond(
            step >= FIRST,
            lambda held: jax.lax.scan(partial(improve, kept, filled), held, passes)[0],
            lambda held: held,
            held,
        )
        return (held, (later, state), kept, key), (info["score_mm"].sum(), done.sum())

    @jax.jit
    def train(key):
        own, other, begin, learn = jax.random.split(key, 4)
        critics = jax.vmap(lambda key: perceptron(key, inputs + 1, 1, 1.0))(jax.random.split(other))
        learner = Learner(perceptron(own, inputs, 2, 0.01), critics, critics, jnp.log(0.1))
        lifts = jax.vmap(env.reset)(jax.random.split(begin, ENVS))
        number = jnp.zeros((KEPT, ENVS))
        past = jnp.zeros((KEPT, ENVS, inputs))
        start = ((learner, optimiser.init(learner)), lifts)
        start = (*start, Moment(past, number, number, past, number), learn)
        (held, *_), found = jax.lax.scan(round_of, start, jnp.arange(rounds))
        return held[0].actor, found

    return train


def main():
    """Train, and write the submission."""
    arguments = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    arguments.add_argument("--task", default="level", help="level, agree, ball, intent, ...")
    arguments.add_argument("--steps", type=float, default=1e6, help="control steps")
    arguments.add_argument("--seed", type=int, default=0)
    arguments.add_argument("--out", type=Path, required=True, help="folder of the submission")
    given = arguments.parse_args()

    least = ENVS * (FIRST + 1)  # One step of all lifts to learn from.
    if not least <= given.steps < math.inf:
        raise InputError(f"--steps must be finite, and {least} or more; got {given.steps:g}")
    colift.twin.TrainingView.check_folder(given.out)
    rounds = round(given.steps / ENVS)
    view = colift.twin.TrainingView(colift.twin.make(given.task, seed=given.seed))
    begin = time.perf_counter()
    train = make_train(colift.twin.Single(view), rounds)
    actor, (scores, ended) = jax.block_until_ready(train(jax.random.key(given.seed)))
    taken = time.perf_counter() - begin
    part = max(rounds // 10, 1)
    for place in range(part, rounds + 1, part):
        mean = scores[place - part : place].sum() / max(ended[place - part : place].sum(), 1)
        print(f"{place * ENVS:10,} steps  {mean:7.2f} mm")
    weights = {**actor, "w2": actor["w2"][:1], "b2": actor["b2"][:1]}  # Without the spread.
    trained_on = f"{rounds * ENVS:,} steps of the twin with drawn people."
    folder = view.write(given.out, weights, name=f"sac seed {given.seed}", trained_on=trained_on)
    print(f"{mean:.2f} mm with noise, {taken:.0f} s: {folder}")


if __name__ == "__main__":
    try:
        main()
    except InputError as error:
        raise SystemExit(f"error: {error}") from None
