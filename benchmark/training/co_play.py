"""Fictitious co-play on the twin: a robot for people whom it has not met, without data of people.

A population of people is made by self-play: from each of several trainings with different seeds,
the person at the beginning, half-way and at the end is kept, so that habits and skills differ. Then
a robot is trained with all of them, who no longer learn (D. Strouse et al., "Collaborating with
humans without human data", NeurIPS 2021).
"""

import functools
from collections.abc import Callable
from concurrent.futures import Executor
from functools import partial
from typing import NamedTuple

import jax
import jax.numpy as jnp
from colift.benchmark.training import person_seat
from colift.benchmark.training.actor_critic import Learner, Tree, decide, learn, weights
from colift.benchmark.training.course import Course
from colift.benchmark.training.ppo_settings import KEPT, MOST_POPULATION, CoPlaySettings
from colift.benchmark.training.proximal_run import run_updates
from colift.benchmark.training.result import write_policy
from colift.benchmark.training.self_play import (
    Pair,
    collect,
    compiled_update,
    drawn_goals,
    drawn_people,
    new_pair,
)
from colift.benchmark.twin.body import Body


class Stage(NamedTuple):
    """The state of a training by co-play."""

    pair: Pair
    """The pair that learns by self-play; in the end, the robot that learns with the population."""
    population: Tree
    """Parameters of the people who were kept, each array with the first axis (3 * population)."""


def train_co_play(
    settings: CoPlaySettings,
    course: Course,
    *,
    executor: Executor | None = None,
    progress: Callable[[int], None] = lambda updates: None,
) -> None:
    """Train a population and a robot, or resume this, and write the robot into the course's folder.

    The points of the curve are errors in the engine with the benchmark's people, from whom nothing
    is learned: of the robots of the self-play, then of the one that is written.

    Parameters
    ----------
    settings, course
        Settings of the training, and the folder for its results.
    executor
        Plays the lifts of the curve; None plays them in this process.
    progress
        Called with the number of updates that were finished since the last call.

    Raises
    ------
    InputError
        If the course cannot be resumed, or a file cannot be written.
    """
    arms = drawn_people(settings, course.seed)
    together, with_all = compiled_update(settings), _compiled(settings)
    moments = (0, settings.updates // 2, settings.updates)

    def update(stage: Stage, number: int) -> tuple[Stage, int]:
        training, done = divmod(number, settings.updates)
        pair, population = stage
        key = jax.random.fold_in(jax.random.key(course.seed), number)
        if done == 0:
            pair = new_pair(settings, (MOST_POPULATION + 1) * course.seed + training)
        if training == settings.population:
            pair = pair._replace(robot=with_all(pair.robot, population, arms, key))
        else:
            if done == 0:
                population = with_person(population, KEPT * training, pair)
            pair = together(pair, arms, key)
            if done + 1 in moments:
                place = KEPT * training + moments.index(done + 1)
                population = with_person(population, place, pair)
        return Stage(pair, population), settings.lifts * person_seat.STEPS

    stage = run_updates(
        course,
        first_stage(settings, course.seed),
        update,
        (settings.population + 1) * settings.updates,
        policy=lambda stage: weights(stage.pair.robot.parameters),
        executor=executor,
        progress=progress,
    )
    write_policy(
        course,
        weights(stage.pair.robot.parameters),
        description=f"A straight line through the human's last heights, corrected by a network of "
        f"2 x {settings.hidden} units, trained by fictitious co-play with "
        f"{KEPT * settings.population} learned people.",
        trained_on="Lifts of colift's twin with learned people: no data of people, and no "
        "behaviour of the benchmark.",
    )


def first_stage(settings: CoPlaySettings, seed: int) -> Stage:
    """Return the initial state: nobody has learned, and nobody is kept."""
    pair = new_pair(settings, seed)
    places = KEPT * settings.population
    return Stage(
        pair,
        jax.tree.map(lambda leaf: jnp.zeros((places, *leaf.shape)), pair.person.parameters),
    )


def with_person(population: Tree, place: int, pair: Pair) -> Tree:
    """Return the population with the person of a pair in a place."""
    return jax.tree.map(
        lambda kept, leaf: kept.at[place].set(leaf), population, pair.person.parameters
    )


@functools.cache
def _compiled(settings: CoPlaySettings) -> Callable[[Learner, Tree, Body, jax.Array], Learner]:
    """Return the update of a robot with a population, compiled once for all seeds."""
    return jax.jit(partial(_update, settings))


def _update(
    settings: CoPlaySettings, robot: Learner, population: Tree, arms: Body, key: jax.Array
) -> Learner:
    """Return the robot after lifts with the population, with equally many for each person."""
    goals, noise, order = jax.random.split(key, 3)
    member = jnp.arange(settings.lifts) % (KEPT * settings.population)
    chosen = jax.tree.map(lambda leaf: leaf[member], population)
    lifts = drawn_goals(settings, arms, goals)
    person = partial(jax.vmap(decide), chosen)
    mine, _ = collect(settings, partial(decide, robot.parameters), person, lifts, noise)
    return learn(settings, robot, mine, order)
