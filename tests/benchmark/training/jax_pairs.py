"""People of the twins who learn together with a robot."""

import jax.numpy as jnp
import numpy as np
import pytest
from colift.benchmark.training.apg_settings import ApgSettings
from colift.benchmark.training.pairs import PairLesson, cross_play
from colift.benchmark.training.touch_lesson import TouchLesson
from colift.benchmark.twin.learning_person import LearningPerson
from colift.benchmark.twin.rollout import rollout

TINY = ApgSettings(task="intent", updates=1, lifts=4, batch=4, units=3)


def test_pairs_that_learned_apart_are_played_across():
    played = cross_play(2, TINY)
    assert played.shape == (2, 2)
    assert np.isfinite(played).all()
    assert len(set(played.ravel().tolist())) == 4


def yielding(memory, seen):
    return memory, -0.03 * seen[5]


@pytest.mark.parametrize("task", ["intent", "agree", "ball"])
def test_a_person_who_adds_nothing_is_the_benchmarks(task):
    lesson = TouchLesson(task)
    lifts = PairLesson(lesson).draw(TINY)

    def played(person):
        return np.asarray(rollout(lesson.twin, yielding, None, lifts, person=person).rmse_mm)

    def adding(share):
        def policy(memory, view):
            assert view.shape == (3 + lesson.known(), lifts.size)
            return memory, share * jnp.tanh(view[:2])

        return LearningPerson(policy, None)

    alone = played(None)
    assert np.isclose(alone, played(adding(0.0)), rtol=0.01).all()
    assert not np.isclose(alone, played(adding(1.0)), rtol=0.01).all()
