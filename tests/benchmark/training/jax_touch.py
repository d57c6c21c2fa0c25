"""A small training in the twin of a task with touch, and the policy that it becomes."""

import colift
import jax
import jax.numpy as jnp
import numpy as np
import pytest
from colift.agents.control.portable import PORTABLE
from colift.agents.control.recurrent import GatedNetwork
from colift.agents.touch.touch_controller import read_touch
from colift.agents.touch.touch_law import (
    TASK_SENSES,
    TouchNetwork,
    felt_action,
    inputs_of,
    touch_at_rest,
)
from colift.benchmark.suites.catalogue import make_scenario
from colift.benchmark.suites.suite import Suite
from colift.benchmark.training import apg, apg_course, validation
from colift.benchmark.training.apg_settings import NAME, ApgSettings
from colift.benchmark.training.course import open_course
from colift.benchmark.training.lesson import first_network
from colift.benchmark.training.lessons import lesson_of
from colift.benchmark.training.touch_lesson import TWINS, touch_policy
from colift.benchmark.training.validation import VALIDATION_SEEDS

TINY = ApgSettings(task="intent", updates=2, lifts=4, batch=4, units=3)


@pytest.fixture(scope="module")
def whole():
    return list(apg.updates(TINY, 0))


@pytest.mark.parametrize("task", TASK_SENSES)
def test_the_network_acts_the_same_in_numpy(task):
    made = first_network(inputs_of(task), 3, 0)
    plain = GatedNetwork(*(np.asarray(array, np.float64) for array in made))
    policy, many = touch_policy(TouchNetwork(task, made), 1)
    memory, rng = touch_at_rest(plain), np.random.default_rng(0)
    for _ in range(5):
        view = 0.1 + 0.01 * rng.standard_normal(len(TASK_SENSES[task].observation))
        memory, action = felt_action(TouchNetwork(task, plain), memory, view, PORTABLE)
        many, actions = policy(many, view[:, np.newaxis].astype(np.float32))
        assert float(actions[0]) == pytest.approx(action, abs=1e-5)


def test_the_manners_of_a_batch_are_drawn_anew_about_those_of_the_population():
    for task, twin in TWINS.items():
        pool = lesson_of(task).draw(TINY)
        one, other = (twin.manners(pool, jax.random.key(seed), 0.2) for seed in (0, 1))
        changed = [
            name
            for name in type(pool)._fields
            if not all(
                jnp.array_equal(a, b)
                for a, b in zip(
                    jax.tree.leaves(getattr(one, name)),
                    jax.tree.leaves(getattr(other, name)),
                    strict=True,
                )
            )
        ]
        assert changed, task
        assert not {"noise", "steps", "latency"} & set(changed)


@pytest.mark.slow
def test_a_training_ends_with_a_submission_that_plays_its_task(tmp_path, monkeypatch, whole):
    monkeypatch.setattr(validation, "VALIDATION_SEEDS", VALIDATION_SEEDS[:2])
    course = open_course(tmp_path, NAME, TINY, 0)
    apg_course.train_apg(TINY, course)
    learned = read_touch(course.policy / "weights.npz")
    assert learned.task == "intent"
    for found, made in zip(learned.network, whole[-1].learner.network, strict=True):
        assert np.array_equal(found, np.asarray(made, np.float64))
    assert len(course.curve) == 1
    scenario = make_scenario("pivot", task="intent")
    suite = Suite(name="one", scenarios=(scenario,), seeds=(0,))
    assert 1 < colift.evaluate(course.policy, suite, isolation="none").rmse_mm < 200
