"""Networks of one kind, trained alike, that differ in what they have to infer."""

from collections.abc import Callable
from dataclasses import replace

import numpy as np
from colift.agents.control.recurrent import GatedNetwork, network_of
from colift.benchmark.episode.conditions import Conditions
from colift.benchmark.training.apg import first_learner, updates
from colift.benchmark.training.apg_settings import ApgSettings
from colift.benchmark.training.conditioned_lesson import ConditionedLesson, told_pool
from colift.benchmark.training.told_network import ToldNetwork
from colift.benchmark.training.variants import VARIANTS


def train_variants(
    lesson: ConditionedLesson,
    settings: ApgSettings,
    seed: int = 0,
    progress: Callable[[int], None] = lambda updates: None,
) -> dict[str, ToldNetwork]:
    """Return the trained networks of :data:`VARIANTS`, with one budget and the same first weights.

    Parameters
    ----------
    lesson
        The lesson of a suite.
    settings
        The budget: updates, lifts, batch, units and rate.
    seed
        Seed of the first weights and of the batches.
    progress
        Called with the number of updates since the last call.
    """
    narrow = usual_delay(lesson.conditions)
    drawn = {
        usual: lesson.lifts(settings, narrow if usual else lesson.conditions)
        for usual in (True, False)
    }
    found = {}
    for name, variant in VARIANTS.items():
        telling = replace(lesson.telling, sensor=variant.sensor, person=variant.person)
        pool = told_pool(drawn[variant.usual], telling)
        learner = first_learner(settings, seed, lesson)
        for update in updates(settings, seed, learner, pool, lesson):
            learner = update.learner
            progress(1)
        conditions = narrow if variant.usual else lesson.conditions
        network = _in_numpy(learner.network)
        found[name] = ToldNetwork(network=network, telling=telling, conditions=conditions)
    return found


def usual_delay(conditions: Conditions) -> Conditions:
    """Return conditions in which each sample is as old as in the suites without conditions."""
    usual = Conditions()
    return replace(
        conditions,
        latency=usual.latency,
        jitter=usual.jitter,
        loss=usual.loss,
        burst=usual.burst,
    )


def _in_numpy(network: GatedNetwork) -> GatedNetwork:
    arrays = {name: np.asarray(array) for name, array in network._asdict().items()}
    return network_of(arrays, "trained weights", network.inputs.shape[1])
