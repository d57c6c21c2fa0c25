"""Training on a suite with conditions: other people, its behaviours, and a loss that falls."""

import dataclasses

import numpy as np
import pytest
from colift.base.errors import InputError
from colift.benchmark.suites.ranges import TRAINING_PEOPLE
from colift.benchmark.suites.suite import make_suite
from colift.benchmark.training.conditioned_lesson import LONGEST, ConditionedLesson, told_pool
from colift.benchmark.training.inferring import train_variants
from colift.benchmark.training.variants import TOLD_BOTH, UNTOLD, USUAL, budget

SUITE = make_suite("robust-v1")

SMALL = dataclasses.replace(budget(2), lifts=10, batch=8, units=4)


def test_its_lifts_have_the_suite_s_behaviours_without_those_for_tests_and_other_people():
    lesson = ConditionedLesson(SUITE)
    lifts = [each.scenario for each in lesson.lifts(SMALL, lesson.conditions)]
    known = {each.subject.name for each in SUITE.scenarios}
    assert {each.behaviour for each in lifts} == {"wait", "dip", "stop", "turn_back", "follow"}
    assert len({each.subject.name for each in lifts}) == len(lifts)
    for each in lifts:
        assert each.subject.name not in known
        assert int(each.subject.name.removeprefix("draw-")) in TRAINING_PEOPLE
        assert each.conditions == lesson.conditions


def test_one_budget_trains_networks_that_differ_in_what_they_are_told():
    done = []
    found = train_variants(ConditionedLesson(SUITE), SMALL, progress=done.append)
    assert sum(done) == SMALL.updates * len(found)
    assert found[USUAL].conditions.latency == (0.1, 0.1)
    assert found[USUAL].untold
    assert found[UNTOLD].untold
    both = found[TOLD_BOTH]
    assert both.telling.sensor
    assert both.telling.person
    # The inputs that are not told have the first weights, those that are have learned.
    own = both.network.inputs[:, 6:]
    assert (found[UNTOLD].network.inputs[:, 6:] == found[USUAL].network.inputs[:, 6:]).all()
    assert (own != found[UNTOLD].network.inputs[:, 6:]).any()
    assert np.isfinite(own).all()


def test_a_long_lift_is_cut_off_with_what_is_told_in_it():
    lesson = ConditionedLesson(SUITE)
    drawn = lesson.lifts(dataclasses.replace(SMALL, lifts=30), lesson.conditions)
    pool = told_pool(drawn, lesson.telling)
    whole = [
        np.asarray(lesson.telling.numbers(each.scenario, each.conditions), np.float32)
        for each in drawn
    ]
    most = round(LONGEST / SUITE.scenarios[0].control_period)
    assert max(map(len, whole)) - 1 > most  # One more is for the time after the last step.
    assert len(pool.told) == most
    for index, (lift, numbers) in enumerate(zip(drawn, whole, strict=True)):
        steps = len(lift.ages)
        assert steps == min(len(numbers) - 1, most)
        np.testing.assert_array_equal(pool.told[:steps, :, index], numbers[:steps])


def test_suites_without_conditions_have_no_such_lesson():
    with pytest.raises(InputError, match="the same conditions"):
        ConditionedLesson(make_suite("standard-v1"))
    unseen = tuple(each for each in SUITE.scenarios if each.behaviour == "waltz")
    with pytest.raises(InputError, match="for tests alone"):
        ConditionedLesson(dataclasses.replace(SUITE, scenarios=unseen))
