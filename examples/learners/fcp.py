"""Fictitious co-play: a robot that learns with people who learned without people.

After Strouse et al. 2021 (arXiv 2110.08176). First some pairs learn apart from each other, by
``mappo.py``; the person of each is kept as it is at the beginning, half way and at the end. Then a
new robot learns, by PPO, with all of these people, who no longer learn::

    python examples/learners/fcp.py --task ball --pairs 4 --out fcp
    colift run fcp --suite ball-v1
"""

import argparse
import time
from pathlib import Path

import colift.twin
import jax
import jax.numpy as jnp
from colift.base.errors import InputError
from mappo import (
    ENVS,
    LENGTH,
    SPREAD,
    Moment,
    falling_adam,
    improved,
    log_chance,
    make_update,
    mean_score,
    output,
    perceptron,
    updates_of,
    value,
)


def population(env, pairs, updates, key):
    """Return the people of some pairs, each at three ages, as weights (3 pairs, ...)."""
    begin, update = make_update(env, updates, central=False)

    @jax.jit
    def one(key):
        first, learn = jax.random.split(key)
        keys = jax.random.split(learn, updates)
        young = begin(first)
        half, _ = jax.lax.scan(update, young, keys[: updates // 2])
        old, _ = jax.lax.scan(update, half, keys[updates // 2 :])
        ages = [learners["human"]["actor"] for learners, *_ in (young, half, old)]
        return jax.tree.map(lambda *each: jnp.stack(each), *ages)

    people = [one(each) for each in jax.random.split(key, pairs)]
    return jax.tree.map(lambda *each: jnp.concatenate(each), *people)


def make_train(env, people, updates):
    """Return the function that trains a robot with some people: its weights, and scores."""
    optimiser, inputs = falling_adam(updates), env.observation_space("robot").shape[0]
    count = len(people["b0"])

    def step(learner, who, now, key):
        """Play a step of all lifts, each with a person of its own."""
        seen, state = now
        noise, draw = jax.random.split(key)
        mean = jnp.tanh(output(learner["actor"], seen["robot"]))
        action = mean + jnp.exp(learner["spread"]) * jax.random.normal(noise, mean.shape)
        all_people = jax.vmap(output, in_axes=(0, None))(people, seen["human"])
        human = jnp.tanh(all_people[who, jnp.arange(ENVS)])
        keys = jax.random.split(draw, ENVS)
        actions = {"robot": action, "human": human}
        after, state, rewards, dones, infos = jax.vmap(env.step)(keys, state, actions)
        own = seen["robot"]
        chance, estimate = log_chance(learner, own, action), value(learner, own)
        moment = Moment(own, own, action, chance, estimate, rewards["robot"], dones["robot"])
        return (after, state), (moment, infos["score_mm"][:, 0])

    def update(now, key):
        """Collect with other people, and improve the robot."""
        learner, momentum, lifts = now
        draw, play, mix = jax.random.split(key, 3)
        who = jax.random.randint(draw, (ENVS,), 0, count)
        lifts, (moments, scores) = jax.lax.scan(
            lambda now, key: step(learner, who, now, key), lifts, jax.random.split(play, LENGTH)
        )
        last = lifts[0]["robot"]
        learner, momentum = improved(optimiser, learner, momentum, moments, last, mix)
        return (learner, momentum, lifts), mean_score(scores, moments.done)

    @jax.jit
    def train(key):
        own, judge, begin, learn = jax.random.split(key, 4)
        learner = {
            "actor": perceptron(own, inputs, 1, 0.01),
            "critic": perceptron(judge, inputs, 1, 1.0),
            "spread": jnp.full(1, SPREAD),
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
    arguments.add_argument("--pairs", type=int, default=4, help="pairs that learn first")
    arguments.add_argument(
        "--steps", type=float, default=5e6, help="control steps of each training"
    )
    arguments.add_argument("--seed", type=int, default=0)
    arguments.add_argument("--out", type=Path, required=True, help="folder of the submission")
    given = arguments.parse_args()

    if given.pairs < 1:
        raise InputError(f"--pairs must be at least 1, got {given.pairs}")
    updates = updates_of(given.steps)
    colift.twin.TrainingView.check_folder(given.out)
    view = colift.twin.TrainingView(colift.twin.make(given.task, agents="both", seed=given.seed))
    begin = time.perf_counter()
    first, learn = jax.random.split(jax.random.key(given.seed))
    people = population(view, given.pairs, updates, first)
    robot, scores = jax.block_until_ready(make_train(view, people, updates)(learn))
    taken = time.perf_counter() - begin
    for place in range(0, updates, max(updates // 10, 1)):
        print(f"{(place + 1) * ENVS * LENGTH:10,} steps  {scores[place]:7.2f} mm")
    trained_on = f"{given.pairs} pairs, and {updates * ENVS * LENGTH:,} steps with their people."
    folder = view.write(given.out, robot, name=f"fcp seed {given.seed}", trained_on=trained_on)
    print(f"{scores[-1]:.2f} mm with these people and noise, {taken:.0f} s: {folder}")


if __name__ == "__main__":
    try:
        main()
    except InputError as error:
        raise SystemExit(f"error: {error}") from None
