"""A small training in the twin of a task with touch, and the policy that it becomes."""

import colift
import jax
import numpy as np
import pytest
from colift.agents.control.portable import PORTABLE
from colift.agents.control.recurrent import GatedNetwork
from colift.agents.tasks.touch.alone_law import law_of, ports_of
from colift.agents.tasks.touch.touch_controller import read_touch
from colift.agents.tasks.touch.touch_law import TouchNetwork, touch_at_rest
from colift.base.registry import TASKS, own_entries
from colift.benchmark.suites.catalogue import make_scenario, make_task
from colift.benchmark.suites.suite import Suite
from colift.benchmark.training import apg, apg_course, touch_lesson
from colift.benchmark.training.apg_settings import NAME, ApgSettings
from colift.benchmark.training.course import open_course
from colift.benchmark.training.lesson import first_network
from colift.benchmark.training.lessons import lesson_of
from colift.benchmark.training.touch_lesson import touch_policy
from colift.benchmark.training.validation import VALIDATION_SEEDS
from colift.benchmark.twin.people import with_new_manners

WITH_RULES = [name for name in own_entries(TASKS) if make_task(name).touch]
TINY = ApgSettings(task="intent", updates=2, lifts=4, batch=4, units=3)


@pytest.fixture(scope="module")
def whole():
    return list(apg.updates(TINY, 0))


@pytest.mark.parametrize("alone", [False, True])
@pytest.mark.parametrize("task", WITH_RULES)
def test_the_network_acts_the_same_in_numpy(task, alone):
    senses = make_task(task).senses
    inputs, outputs = ports_of(senses, alone=alone)
    made = first_network(inputs, 3, 0, outputs)
    plain = GatedNetwork(*(np.asarray(array, np.float64) for array in made))
    learned = TouchNetwork(task, senses, plain, alone)
    policy, many = touch_policy(TouchNetwork(task, senses, made, alone), 1)
    memory, rng = touch_at_rest(learned), np.random.default_rng(0)
    for _ in range(5):
        view = 0.1 + 0.01 * rng.standard_normal(learned.expected)
        memory, action = law_of(learned)(learned, memory, view, PORTABLE)
        many, actions = policy(many, view[:, np.newaxis].astype(np.float32))
        assert float(actions[0]) == pytest.approx(action, abs=1e-5)


@pytest.mark.parametrize("task", WITH_RULES)
def test_the_manners_of_a_batch_are_drawn_anew_about_those_of_the_population(task):
    lesson = lesson_of(task)
    pool, person = lesson.draw(TINY), lesson.twin.task.person
    one, other = (
        with_new_manners(person, pool, jax.random.key(seed), 0.2)._asdict() for seed in (0, 1)
    )
    for name, trait in person.traits.items():
        drawn = np.array([getattr(each["drawn"].manner, name) for each in (one, other)])
        beyond = 0.1 * (trait.high - trait.low) * trait.wider + 1e-6
        assert (drawn[0] != drawn[1]).all()
        assert max(trait.low - beyond, trait.least) <= drawn.min()
        assert drawn.max() <= min(trait.high + beyond, trait.most)
    for name in ("gain", "tremor", "errors", "steps", "ages"):
        assert np.array_equal(one[name], other[name])


@pytest.mark.slow
def test_a_training_ends_with_a_submission_that_plays_its_task(tmp_path, monkeypatch, whole):
    monkeypatch.setattr(touch_lesson, "VALIDATION_SEEDS", VALIDATION_SEEDS[:2])
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
