"""Self-play on the twin: a robot and a person, two networks, learn from the same lifts.

No data of people and no behaviour of the benchmark is used: see :mod:`.person_seat`. The robot's
reward is the level of the table alone, as in the score; the person's adds the distance to its goal.
Each learns by :func:`.actor_critic.learn` as if the other were a part of the world (independent
learning, A. Tampuu et al., "Multiagent cooperation and competition with deep reinforcement
learning", PLOS ONE 2017).
"""

import functools
from collections.abc import Callable
from concurrent.futures import Executor
from functools import partial
from typing import NamedTuple

import jax
import jax.numpy as jnp
import numpy as np
from colift.agents.agent import FRAME
from colift.benchmark.episode.scenario import CONTROL_PERIOD, LATENCY
from colift.benchmark.training import person_seat, robot_seat
from colift.benchmark.training.actor_critic import (
    Decision,
    Experience,
    Learner,
    decide,
    learn,
    new_learner,
    weights,
)
from colift.benchmark.training.course import Course
from colift.benchmark.training.person_seat import Goals
from colift.benchmark.training.ppo import start as robot_start
from colift.benchmark.training.ppo_settings import SelfPlaySettings
from colift.benchmark.training.proximal_run import run_updates
from colift.benchmark.training.result import write_policy
from colift.benchmark.training.validation import LEARNING_SEEDS
from colift.benchmark.twin import playing as twin
from colift.benchmark.twin.body import Body
from colift.benchmark.twin.playing import LiftState

State = tuple[LiftState, robot_seat.PastSenses, person_seat.Past]

Decide = Callable[[jax.Array, jax.Array], Decision]
"""Returns the decisions of an agent for inputs (n, k), and noise (n,)."""


class Pair(NamedTuple):
    """A robot and a person who learn together."""

    robot: Learner
    person: Learner


def train_self_play(
    settings: SelfPlaySettings,
    course: Course,
    *,
    executor: Executor | None = None,
    progress: Callable[[int], None] = lambda updates: None,
) -> None:
    """Train a pair and write its robot into the folder of the course; resume it if interrupted.

    The points of the curve are errors in the engine with the benchmark's people, from whom nothing
    is learned.

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
    update = compiled_update(settings)

    def numbered(pair: Pair, number: int) -> tuple[Pair, int]:
        key = jax.random.fold_in(jax.random.key(course.seed), number)
        return update(pair, arms, key), settings.lifts * person_seat.STEPS

    pair = run_updates(
        course,
        new_pair(settings, course.seed),
        numbered,
        settings.updates,
        policy=lambda pair: weights(pair.robot.parameters),
        executor=executor,
        progress=progress,
    )
    write_policy(
        course,
        weights(pair.robot.parameters),
        description=f"A straight line through the human's last heights, corrected by a network of "
        f"2 x {settings.hidden} units, trained by self-play with a person who learned, too.",
        trained_on="Lifts of colift's twin with a learned person: no data of people, and no "
        "behaviour of the benchmark.",
    )


def new_pair(settings: SelfPlaySettings, seed: int) -> Pair:
    """Return a pair that has not learned anything."""
    key = jax.random.fold_in(jax.random.key(seed), 2 * 10**6)
    person = new_learner(settings, len(person_seat.SCALES), key)
    return Pair(robot_start(settings, seed), person)


def drawn_people(settings: SelfPlaySettings, seed: int) -> Body:
    """Return the arms of the people of a training."""
    rng = np.random.default_rng([seed, 1])
    return person_seat.people(rng.choice(LEARNING_SEEDS, settings.pool, replace=False).tolist())


def drawn_goals(settings: SelfPlaySettings, arms: Body, key: jax.Array) -> Goals:
    """Return the lifts of an update."""
    choice, goals = jax.random.split(key)
    chosen = jax.random.choice(choice, settings.pool, (settings.lifts,), replace=False)
    return person_seat.draw_goals(jax.tree.map(lambda array: array[chosen], arms), goals)


def collect(
    settings: SelfPlaySettings, robot: Decide, person: Decide, lifts: Goals, key: jax.Array
) -> tuple[Experience, Experience]:
    """Return whole lifts as the robot and as the person experience them.

    Parameters
    ----------
    settings
        Settings of the training.
    robot, person
        The agents.
    lifts
        Goals, people and noise.
    key
        Random key of the noise of the agents' actions.
    """
    count = lifts.goal.shape[1]
    latency = jnp.full(count, round(LATENCY / FRAME))

    def step(
        state: State, now: tuple[jax.Array, jax.Array, jax.Array]
    ) -> tuple[State, tuple[Experience, Experience]]:
        playing, senses, past = state
        goal, noise, drawn = now
        view = twin.observe(playing, noise, latency, CONTROL_PERIOD)
        senses, metres = robot_seat.sense(senses, view, playing.step == 0)
        mine = robot_seat.scaled(metres)
        past, theirs = person_seat.sense(playing, lifts.body, past, goal)
        decided, meant = robot(mine, drawn[0]), person(theirs, drawn[1])
        past, references = person_seat.moved(past, goal, meant.action)
        change = robot_seat.change(metres, decided.action)
        playing, frames = twin.hands_step(playing, lifts.body, references, change)
        level, valid = robot_seat.reward(frames), jnp.ones(count)
        wanted = level - settings.haste * person_seat.cost(frames, goal)
        return (playing, senses, past), (
            Experience(mine, *decided, level, valid),
            Experience(theirs, *meant, wanted, valid),
        )

    rest = (
        twin.at_rest(count),
        robot_seat.nothing_sensed(settings.steps, count),
        person_seat.nothing_sensed(count),
    )
    drawn = jax.random.normal(key, (person_seat.STEPS, 2, count))
    return jax.lax.scan(step, rest, (lifts.goal, lifts.noise, drawn))[1]


@functools.cache
def compiled_update(settings: SelfPlaySettings) -> Callable[[Pair, Body, jax.Array], Pair]:
    """Return the update of a pair, compiled once for all seeds."""
    return jax.jit(partial(_update, settings))


def _update(settings: SelfPlaySettings, pair: Pair, arms: Body, key: jax.Array) -> Pair:
    goals, noise, robots, persons = jax.random.split(key, 4)
    robot, person = (partial(decide, each.parameters) for each in pair)
    lifts = drawn_goals(settings, arms, goals)
    mine, theirs = collect(settings, robot, person, lifts, noise)
    return Pair(
        robot=learn(settings, pair.robot, mine, robots),
        person=learn(settings, pair.person, theirs, persons),
    )
