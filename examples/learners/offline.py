"""Learning the robot's policy from a data set alone: behaviour cloning, or implicit Q-learning.

``bc`` fits the actions of the data (Pomerleau 1988, ALVINN). ``iql`` (Kostrikov, Nair and Levine
2022, arXiv 2110.06169) learns a value V and action values Q1, Q2 from the actions of the data, V as
nearly the best value that its robots reached, and weighs each action by its advantage. It needs the
extras ``train`` and ``export``::

    colift export --set mixed --lifts 3000 --out mixed
    python examples/learners/offline.py mixed --method iql --out iql
    colift run iql
"""

import argparse
import time
from itertools import pairwise
from pathlib import Path
from typing import NamedTuple

import colift.twin
import jax
import jax.numpy as jnp
import minari
import numpy as np
import optax
from colift.agents.submissions.network.policy import CORRECTION, Senses, line, scales
from colift.base.errors import InputError

STEPS = 20  # Steps of the human's motion among the inputs.
UNITS = 64  # Tanh units of each of two layers.
UPDATES, BATCH, RATE = 20_000, 512, 1e-3  # The learning rate falls to 0.
CENTIMETRES = 100.0  # Scale of the rewards [1/m], which are then of the order of one.
DISCOUNT, SLOW = 0.7, 0.005  # Weight of a step later, and pace of the slow copies.
EXPECTILE, SHARP, MOST = 0.8, 2.0, 20.0  # Of the value; of the weights; and the largest weight.


class Moments(NamedTuple):
    """All steps of a data set."""

    seen: jax.Array
    action: jax.Array  # In shares of the largest correction.
    reward: jax.Array
    later: jax.Array
    ended: jax.Array


class Learner(NamedTuple):
    """The networks of actions, of the value, and of action values."""

    actor: dict
    value: dict
    critics: dict


def read(folder):
    """Return the steps of a data set, in the training view: inputs near one, and corrections."""
    try:
        episodes = minari.MinariDataset(folder / "data")
    except ValueError as error:
        raise InputError(f"{folder} is not a folder that colift export wrote: {error}") from error
    parts = []
    for episode in episodes.iterate_episodes():
        senses = Senses(STEPS)
        whole = np.array([senses(each) for each in episode.observations])
        actions = episode.actions.ravel()
        lines = np.array([line(each) for each in whole[:-1]])
        ended = np.zeros(len(actions))
        ended[-1] = 1.0
        inputs = whole / scales(STEPS)
        correction = np.clip((actions - lines) / CORRECTION, -1.0, 1.0)
        rewards = CENTIMETRES * np.asarray(episode.rewards)
        parts.append(Moments(inputs[:-1], correction, rewards, inputs[1:], ended))
    arrays = (np.concatenate(each) for each in zip(*parts, strict=True))
    return Moments(*(jnp.asarray(each, jnp.float32) for each in arrays))


def perceptron(key, inputs, gain):
    """Return the weights of two layers of tanh units, and of one output of the size ``gain``."""
    weights, sizes = {}, (inputs, UNITS, UNITS, 1)
    for i, (size, outputs) in enumerate(pairwise(sizes)):
        drawn = jax.nn.initializers.orthogonal(2**0.5 if i < 2 else gain)
        weights[f"w{i}"] = drawn(jax.random.fold_in(key, i), (outputs, size))
        weights[f"b{i}"] = jnp.zeros(outputs)
    return weights


def output(weights, seen):
    """Return the output (n,) for inputs (n, k)."""
    for i in range(2):
        seen = jnp.tanh(seen @ weights[f"w{i}"].T + weights[f"b{i}"])
    return (seen @ weights["w2"].T + weights["b2"])[..., 0]


def worths(critics, seen, action):
    """Return both values of actions (2, n)."""
    both = jnp.concatenate((seen, action[:, None]), axis=-1)
    return jax.vmap(output, in_axes=(0, None))(critics, both)


def clone_loss(learner, slow, moment):
    """Return the mean square of the policy's deviation from the data."""
    return ((jnp.tanh(output(learner.actor, moment.seen)) - moment.action) ** 2).mean()


def iql_loss(learner, slow, moment):
    """Return the sum of three losses; none has a gradient in the networks of another."""
    value = output(learner.value, moment.seen)
    advantage = worths(slow, moment.seen, moment.action).min(axis=0) - value
    side = jnp.where(advantage < 0, 1 - EXPECTILE, EXPECTILE)
    value_loss = (side * advantage**2).mean()

    after = jax.lax.stop_gradient(output(learner.value, moment.later))
    aim = moment.reward + DISCOUNT * (1 - moment.ended) * after
    critic_loss = ((worths(learner.critics, moment.seen, moment.action) - aim) ** 2).mean()

    relative = jax.lax.stop_gradient(advantage / jnp.abs(advantage).mean())
    weight = jnp.minimum(jnp.exp(SHARP * relative), MOST)
    miss = jnp.tanh(output(learner.actor, moment.seen)) - moment.action
    return value_loss + critic_loss + (weight * miss**2).mean()


def make_train(loss, updates):
    """Return the function that trains with a loss, from data and a key: the actor."""
    optimiser = optax.adam(optax.cosine_decay_schedule(RATE, updates))

    @jax.jit
    def train(data, key):
        steps, inputs = data.seen.shape
        own, judge, other, learn = jax.random.split(key, 4)
        critics = jax.vmap(lambda key: perceptron(key, inputs + 1, 1.0))(jax.random.split(other))
        first = Learner(perceptron(own, inputs, 0.01), perceptron(judge, inputs, 1.0), critics)

        def update(held, key):
            learner, slow, momentum = held
            chosen = jax.random.randint(key, (BATCH,), 0, steps)
            gradient = jax.grad(loss)(learner, slow, jax.tree.map(lambda each: each[chosen], data))
            change, momentum = optimiser.update(gradient, momentum)
            learner = optax.apply_updates(learner, change)
            slow = optax.incremental_update(learner.critics, slow, SLOW)
            return (learner, slow, momentum), None

        start = (first, critics, optimiser.init(first))
        (learner, *_), _ = jax.lax.scan(update, start, jax.random.split(learn, updates))
        return learner.actor

    return train


def main():
    """Train, and write the submission."""
    arguments = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    arguments.add_argument("data", type=Path, help="folder that colift export wrote")
    arguments.add_argument("--method", choices=("bc", "iql"), default="bc")
    arguments.add_argument("--updates", type=int, default=UPDATES)
    arguments.add_argument("--seed", type=int, default=0)
    arguments.add_argument("--out", type=Path, required=True, help="folder of the submission")
    given = arguments.parse_args()

    if given.updates < 1:
        raise InputError(f"--updates must be at least 1, got {given.updates}")
    colift.twin.TrainingView.check_folder(given.out)
    data = read(given.data)
    view = colift.twin.TrainingView(colift.twin.make("level", lifts=1), STEPS)
    begin = time.perf_counter()
    train = make_train({"bc": clone_loss, "iql": iql_loss}[given.method], given.updates)
    actor = jax.block_until_ready(train(data, jax.random.key(given.seed)))
    taken = time.perf_counter() - begin
    name = f"{given.method} seed {given.seed}"
    folder = view.write(given.out, actor, name=name, trained_on=f"The data set {given.data.name}.")
    print(f"{len(data.action):,} steps, {taken:.0f} s: {folder}")


if __name__ == "__main__":
    try:
        main()
    except InputError as error:
        raise SystemExit(f"error: {error}") from None
