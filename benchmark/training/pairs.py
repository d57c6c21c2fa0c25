"""Pairs of a person and a robot that learn together, and their errors with other partners.

The person adds to the actions of the benchmark's people (:class:`.LearningPerson`); the wrists show
no intention by themselves. Any other signal of the intention is therefore a convention that each
pair finds by itself. All of this is in the twin: no suite and no board is involved.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any, NamedTuple

import jax
import jax.numpy as jnp
import numpy as np
from colift.agents.control.recurrent import GatedNetwork, gated
from colift.benchmark.training.apg import updates
from colift.benchmark.training.apg_settings import ApgSettings
from colift.benchmark.training.lesson import BatchDraw, first_network
from colift.benchmark.training.touch_lesson import TouchLesson
from colift.benchmark.twin.learning_person import SENSES, LearningPerson
from colift.benchmark.twin.people import with_quiet_wrists
from colift.benchmark.twin.policy import JAX
from colift.benchmark.twin.rollout import rollout
from numpy.typing import NDArray


class TrainedPair(NamedTuple):
    """Two networks that were trained together."""

    robot: GatedNetwork
    person: GatedNetwork


@dataclass(frozen=True)
class PairLesson:
    """The lifts and the loss of a pair: the common score, as for a :class:`.TouchLesson`."""

    of_robot: TouchLesson

    def first(self, settings: ApgSettings, seed: int) -> TrainedPair:
        """Return a pair that has not learned anything."""
        inputs = SENSES + self.of_robot.known()
        person = first_network(inputs, settings.units, seed + 1_000_000, outputs=2)
        return TrainedPair(self.of_robot.first(settings, seed), person)

    def draw(self, settings: ApgSettings) -> Any:
        """Return lifts with drawn people whose wrists show no intention."""
        return self.quiet(self.of_robot.draw(settings))

    def loss(
        self, network: TrainedPair, pool: Any, settings: ApgSettings, draw: BatchDraw
    ) -> tuple[jax.Array, jax.Array]:
        """Return the loss [mm], which is the mean RMSE, and the mean RMSE [mm] of a batch."""
        lifts = self.quiet(self.of_robot.batch(pool, settings, draw))
        mean = self.errors(network, lifts).mean()
        return mean, mean

    def quiet(self, lifts: Any) -> Any:
        """Return lifts in which the people's wrists show no intention by themselves."""
        return with_quiet_wrists(self.of_robot.twin.person, lifts)

    def errors(self, pair: TrainedPair, lifts: Any) -> jax.Array:
        """Return the RMSE of lifts (n,) with a pair [mm]."""
        count = lifts.size
        policy, memory = self.of_robot.policy(pair.robot, count)
        person = learned_person(pair.person, count)
        return rollout(self.of_robot.twin, policy, memory, lifts, person=person).rmse_mm


def learned_person(network: GatedNetwork, count: int) -> LearningPerson:
    """Return the person of a network at the beginning of n lifts."""

    def policy(units: jax.Array, inputs: jax.Array) -> tuple[jax.Array, jax.Array]:
        units = gated(network, units, inputs, JAX)
        output = network.output @ jnp.concatenate((units, inputs))
        return units, jnp.tanh(output + network.output_bias[:, jnp.newaxis])

    return LearningPerson(policy, jnp.zeros((network.units, count)))


def cross_play(
    count: int,
    settings: ApgSettings,
    progress: Callable[[int], None] = lambda many: None,
) -> NDArray[np.float64]:
    """Train pairs apart from each other, and return the mean RMSE of each person with each robot.

    Parameters
    ----------
    count
        Number of pairs, with the seeds from 0.
    settings
        Settings of their training; see :func:`.pair_settings`.
    progress
        Called with the number of updates since the last call.

    Returns
    -------
    array
        (persons, robots) [mm], on the validation lifts in the twin.
    """
    lesson = PairLesson(TouchLesson(settings.task))
    pool, pairs = lesson.draw(settings), []
    for seed in range(count):
        for update in updates(settings, seed, pool=pool, lesson=lesson):
            learner = update.learner
            progress(1)
        pairs.append(learner.network)
    return played_across(lesson, pairs)


def played_across(lesson: PairLesson, pairs: Sequence[TrainedPair]) -> NDArray[np.float64]:
    """Return the mean RMSE of each person (rows) with each robot (columns) of some pairs [mm]."""
    lifts = lesson.quiet(lesson.of_robot.validation())
    errors = jax.jit(lambda pair: lesson.errors(pair, lifts).mean())
    return np.array(
        [[float(errors(TrainedPair(two.robot, one.person))) for two in pairs] for one in pairs]
    )
