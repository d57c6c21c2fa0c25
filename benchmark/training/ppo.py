"""Proximal policy optimisation with the benchmark's drawn people, on thousands of the twin's lifts.

In each update the policy plays whole lifts, with noise on its corrections, and is then moved by
:func:`.actor_critic.learn`.
"""

import functools
from collections.abc import Callable, Iterator
from concurrent.futures import Executor
from functools import partial

import jax
import jax.numpy as jnp
import numpy as np
from colift.agents.submissions.network.policy import FIXED
from colift.benchmark.episode.scenario import CONTROL_PERIOD
from colift.benchmark.tasks.level.task import BEHAVIOURS
from colift.benchmark.training import robot_seat
from colift.benchmark.training.actor_critic import (
    Experience,
    Learner,
    Tree,
    decide,
    learn,
    new_learner,
    weights,
)
from colift.benchmark.training.course import Course
from colift.benchmark.training.data import Timing, scenario
from colift.benchmark.training.pool import cut
from colift.benchmark.training.ppo_settings import PpoSettings
from colift.benchmark.training.proximal_run import run_updates
from colift.benchmark.training.result import write_policy
from colift.benchmark.training.robot_seat import PastSenses
from colift.benchmark.training.validation import LEARNING_SEEDS
from colift.benchmark.twin import lifts as twin_lifts
from colift.benchmark.twin import playing as twin
from colift.benchmark.twin.lifts import DrawnLift, Lifts
from colift.benchmark.twin.playing import LiftState


def train_ppo(
    settings: PpoSettings,
    course: Course,
    *,
    executor: Executor | None = None,
    progress: Callable[[int], None] = lambda updates: None,
) -> None:
    """Train a policy and write it into the folder of the course; resume it if it was interrupted.

    The points of the curve are errors in the engine, not in the twin.

    Parameters
    ----------
    settings, course
        Settings of the training, and the folder for its results.
    executor
        Draws the lifts and plays those of the curve; None does both in this process.
    progress
        Called with the number of updates that were finished since the last call.

    Raises
    ------
    InputError
        If the course cannot be resumed, or a file cannot be written.
    """
    pool = draw_pool_of(settings, course.seed, executor)
    update = _compiled(settings)

    def numbered(learner: Learner, number: int) -> tuple[Learner, int]:
        key = jax.random.fold_in(jax.random.key(course.seed), number)
        learner, played = update(learner, pool, key)
        return learner, int(played)

    learner = run_updates(
        course,
        start(settings, course.seed),
        numbered,
        settings.updates,
        policy=lambda learner: weights(learner.parameters),
        executor=executor,
        progress=progress,
    )
    write_policy(
        course,
        weights(learner.parameters),
        description=f"A straight line through the human's last heights, corrected by a network of "
        f"2 x {settings.hidden} units, trained by proximal policy optimisation.",
        trained_on=f"{settings.pool} lifts of colift's twin with drawn people, seeds "
        f"{LEARNING_SEEDS[0]} to {LEARNING_SEEDS[-1]}.",
    )


def start(settings: PpoSettings, seed: int) -> Learner:
    """Return the robot before the first update."""
    key = jax.random.fold_in(jax.random.key(seed), 10**6)
    return new_learner(settings, FIXED + settings.steps, key)


def draw_pool_of(settings: PpoSettings, seed: int, executor: Executor | None = None) -> Lifts:
    """Return the pool of lifts of a training: all behaviours, a new person in each."""
    rng = np.random.default_rng([seed, 1])
    chosen = rng.choice(LEARNING_SEEDS, settings.pool, replace=False).tolist()
    drawn: Iterator[DrawnLift] = map(drawn_lift, chosen)
    if executor is not None:
        drawn = executor.map(drawn_lift, chosen, chunksize=32)
    return twin_lifts.stack(list(drawn))


def drawn_lift(seed: int) -> DrawnLift:
    """Return the lift of a seed and its person; of a long lift, the beginning."""
    return cut(twin_lifts.carried_out(scenario(seed, BEHAVIOURS, Timing()), seed))


def collect(settings: PpoSettings, parameters: Tree, lifts: Lifts, key: jax.Array) -> Experience:
    """Return whole lifts with a policy whose corrections are noisy."""

    def step(
        state: tuple[LiftState, PastSenses], now: tuple[twin.Due, jax.Array]
    ) -> tuple[tuple[LiftState, PastSenses], Experience]:
        playing, senses = state
        due, drawn = now
        view = twin.observe(playing, due.noise, lifts.latency, CONTROL_PERIOD)
        senses, metres = robot_seat.sense(senses, view, playing.step == 0)
        inputs = robot_seat.scaled(metres)
        decision = decide(parameters, inputs, drawn)
        valid = (playing.step < lifts.steps).astype(jnp.float32)
        change = robot_seat.change(metres, decision.action)
        playing, frames = twin.control_step(playing, lifts.body, due, change)
        reward = robot_seat.reward(frames)
        return (playing, senses), Experience(inputs, *decision, reward, valid)

    count, longest = lifts.size, lifts.longest()
    rest = robot_seat.nothing_sensed(settings.steps, count)
    shares = twin.Due(lifts.reference, lifts.seen_target, lifts.noise)
    drawn = jax.random.normal(key, (longest, count))
    _, played = jax.lax.scan(step, (twin.at_rest(count), rest), (shares, drawn))
    return played


@functools.cache
def _compiled(settings: PpoSettings) -> Callable[..., tuple[Learner, jax.Array]]:
    """Return the update, compiled once for all seeds."""
    return jax.jit(partial(_update, settings))


def _update(
    settings: PpoSettings, learner: Learner, pool: Lifts, key: jax.Array
) -> tuple[Learner, jax.Array]:
    """Return the robot after one update, and the steps that were played."""
    choice, noise, order = jax.random.split(key, 3)
    chosen = jax.random.choice(choice, settings.pool, (settings.lifts,), replace=False)
    played = collect(settings, learner.parameters, twin_lifts.some(pool, chosen), noise)
    return learn(settings, learner, played, order), played.valid.sum()
