"""Independent or multi-agent PPO of both seats, on the twin, in one compiled function.

A network takes the person's seat, too: it adds to what the person of the task does. Each seat has
its own policy. With ``--critic own`` each has a critic of what it observes itself (IPPO, de Witt et
al. 2020, arXiv 2011.09533), with ``all`` of what both observe (MAPPO, Yu et al. 2022, arXiv
2103.01955). The robot is written as a submission, and has then to lift with the people of the
score, whom it has not met::

    python examples/learners/mappo.py --task ball --critic all --out mappo
    colift run mappo --suite ball-v1
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

ENVS, LENGTH = 512, 64  # Lifts at a time, and steps of each between two updates.
EPOCHS, PARTS = 4, 8  # Passes over what was collected, and parts of each pass.
UNITS = 64  # Tanh units of each of two layers.
RATE, NORM = 1e-3, 0.5  # Learning rate, falling to 0, and largest norm of a gradient.
DISCOUNT, TRACE, CLIP, VALUE = 0.95, 0.9, 0.2, 0.5
SPREAD = -1.0  # Logarithm of the standard deviation of the first actions.


class Moment(NamedTuple):
    """A step of one seat, for all lifts."""

    seen: jax.Array
    judged: jax.Array  # What the critic sees.
    action: jax.Array
    chance: jax.Array  # Logarithm of the action's probability density.
    value: jax.Array
    reward: jax.Array
    done: jax.Array


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


def value(learner, judged):
    """Return the critic's estimate of the rewards to come (n,)."""
    return output(learner["critic"], judged)[..., 0]


def log_chance(learner, seen, action):
    """Return the logarithm of the density of actions (n, m): normal about the network's."""
    deviation = (action - jnp.tanh(output(learner["actor"], seen))) / jnp.exp(learner["spread"])
    each = -0.5 * deviation**2 - learner["spread"] - 0.5 * jnp.log(2 * jnp.pi)
    return each.sum(axis=-1)


def updates_of(steps):
    """Return the number of updates for a number of control steps."""
    least = ENVS * LENGTH  # One update.
    if not least <= steps < math.inf:
        raise InputError(f"--steps must be finite, and {least} or more; got {steps:g}")
    return round(steps / least)


def make_update(env, updates, central):
    """Return two functions: one that begins from a key, and one that updates both seats."""
    seats, optimiser = env.agents, falling_adam(updates)

    def judged(seen):
        """Return what the critics see."""
        both = jnp.concatenate([seen[seat] for seat in seats], axis=-1)
        return {seat: both if central else seen[seat] for seat in seats}

    def step(learners, now, key):
        """Play a step of all lifts; return it for each seat."""
        seen, state = now
        *noises, draw = jax.random.split(key, len(seats) + 1)
        actions, moments = {}, {}
        for seat, noise in zip(seats, noises, strict=True):
            learner = learners[seat]
            mean = jnp.tanh(output(learner["actor"], seen[seat]))
            actions[seat] = mean + jnp.exp(learner["spread"]) * jax.random.normal(noise, mean.shape)
        keys = jax.random.split(draw, ENVS)
        after, state, rewards, dones, infos = jax.vmap(env.step)(keys, state, actions)
        for seat in seats:
            learner, action, own = learners[seat], actions[seat], judged(seen)[seat]
            chance, estimate = log_chance(learner, seen[seat], action), value(learner, own)
            moments[seat] = Moment(
                seen[seat], own, action, chance, estimate, rewards[seat], dones[seat]
            )
        return (after, state), (moments, infos["score_mm"][:, 0])

    def update(now, key):
        """Collect, and improve both seats; return the mean score of the lifts that ended."""
        learners, momenta, lifts = now
        play, *mix = jax.random.split(key, len(seats) + 1)
        keys = jax.random.split(play, LENGTH)
        lifts, (moments, scores) = jax.lax.scan(
            lambda now, key: step(learners, now, key), lifts, keys
        )
        last = judged(lifts[0])
        for seat, own in zip(seats, mix, strict=True):
            held = learners[seat], momenta[seat]
            learner, momentum = improved(optimiser, *held, moments[seat], last[seat], own)
            learners, momenta = {**learners, seat: learner}, {**momenta, seat: momentum}
        return (learners, momenta, lifts), mean_score(scores, moments[seats[0]].done)

    def begin(key):
        """Return new learners, and lifts before their first step."""
        play, *keys = jax.random.split(key, 1 + len(seats))
        sizes = {seat: env.observation_space(seat).shape[0] for seat in seats}
        learners = {
            seat: {
                "actor": perceptron(own, sizes[seat], env.action_space(seat).shape[0], 0.01),
                "critic": perceptron(own, sum(sizes.values()) if central else sizes[seat], 1, 1.0),
                "spread": jnp.full(env.action_space(seat).shape, SPREAD),
            }
            for seat, own in zip(seats, keys, strict=True)
        }
        momenta = {seat: optimiser.init(learners[seat]) for seat in seats}
        return learners, momenta, jax.vmap(env.reset)(jax.random.split(play, ENVS))

    return begin, update


def improved(optimiser, learner, momentum, moments, last, key):
    """Return a learner and its optimiser's state after some passes over what it did."""
    advantage = advantages(moments, value(learner, last))
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

    return jax.lax.scan(epoch, (learner, momentum), jax.random.split(key, EPOCHS))[0]


def mean_score(scores, done):
    """Return the mean score of the lifts that ended, if any."""
    ended = done.sum()
    return jnp.where(ended, scores.sum() / jnp.maximum(ended, 1), jnp.nan)


def falling_adam(updates):
    """Return Adam with a rate that falls to 0 over the training."""
    falling = optax.linear_schedule(RATE, 0.0, updates * EPOCHS * PARTS)
    return optax.chain(optax.clip_by_global_norm(NORM), optax.adam(falling, eps=1e-5))


def advantages(moments, last):
    """Return the generalised advantage estimates (Schulman et al. 2016)."""

    def back(after, moment):
        gain, estimate = after
        goes_on = 1.0 - moment.done
        surprise = moment.reward + DISCOUNT * goes_on * estimate - moment.value
        gain = surprise + DISCOUNT * TRACE * goes_on * gain
        return (gain, moment.value), gain

    return jax.lax.scan(back, (jnp.zeros_like(last), last), moments, reverse=True)[1]


def loss(learner, moment, advantage, aim):
    """Return the clipped objective, and the error of the values."""
    advantage = (advantage - advantage.mean()) / (advantage.std() + 1e-8)
    ratio = jnp.exp(log_chance(learner, moment.seen, moment.action) - moment.chance)
    gain = jnp.minimum(ratio * advantage, jnp.clip(ratio, 1 - CLIP, 1 + CLIP) * advantage)
    return VALUE * ((value(learner, moment.judged) - aim) ** 2).mean() - gain.mean()


def main():
    """Train, and write the robot's submission."""
    arguments = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    arguments.add_argument("--task", default="level", help="level, agree, ball, intent, ...")
    arguments.add_argument("--critic", choices=("own", "all"), default="own")
    arguments.add_argument("--steps", type=float, default=5e6, help="control steps")
    arguments.add_argument("--seed", type=int, default=0)
    arguments.add_argument("--out", type=Path, required=True, help="folder of the submission")
    given = arguments.parse_args()

    updates = updates_of(given.steps)
    colift.twin.TrainingView.check_folder(given.out)
    view = colift.twin.TrainingView(colift.twin.make(given.task, agents="both", seed=given.seed))
    start = time.perf_counter()
    begin, update = make_update(view, updates, given.critic == "all")
    first, learn = jax.random.split(jax.random.key(given.seed))
    train = jax.jit(lambda now, keys: jax.lax.scan(update, now, keys))
    (learners, *_), scores = jax.block_until_ready(
        train(begin(first), jax.random.split(learn, updates))
    )
    taken = time.perf_counter() - start
    for place in range(0, updates, max(updates // 10, 1)):
        print(f"{(place + 1) * ENVS * LENGTH:10,} steps  {scores[place]:7.2f} mm")
    name = {"own": "ippo", "all": "mappo"}[given.critic]
    trained_on = f"{updates * ENVS * LENGTH:,} steps of the twin with a person who learned, too."
    robot = learners["robot"]["actor"]
    folder = view.write(given.out, robot, name=f"{name} seed {given.seed}", trained_on=trained_on)
    print(f"{scores[-1]:.2f} mm with each other and noise, {taken:.0f} s: {folder}")


if __name__ == "__main__":
    try:
        main()
    except InputError as error:
        raise SystemExit(f"error: {error}") from None
