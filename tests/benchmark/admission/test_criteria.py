"""Criteria of admission as maths: what they reject by chance, and what they find."""

import math
from dataclasses import replace

import numpy as np
import pytest
from colift.benchmark.admission.criteria import (
    conventions,
    interaction,
    like_people,
    needs_partner,
    no_free_ride,
    rank_changes,
)
from colift.benchmark.admission.fragility import with_fragility
from colift.benchmark.admission.published import PUBLISHED, Compared

from .made_up import errors, evidence

REPEATS = 200


def false_passes(criterion, **settings):
    """Return the share of suites with equal policies, or only better ones, that pass."""
    suites = (errors(seed, (8, 12, 4), **settings) for seed in range(REPEATS))
    return np.mean([criterion(evidence(each)).passed for each in suites])


@pytest.mark.parametrize("criterion", [interaction, rank_changes])
@pytest.mark.parametrize("settings", [{}, {"person": 0.0}, {"policy": 0.3}, {"noise": 1.0}])
def test_without_interaction_at_most_one_suite_in_twenty_passes(criterion, settings):
    assert false_passes(criterion, **settings) <= 0.05


@pytest.mark.parametrize("criterion", [interaction, rank_changes])
def test_a_strong_interaction_is_found(criterion):
    values = errors(3, (8, 25, 4), suits=0.5)
    assert criterion(evidence(values)).passed


def test_a_strong_interaction_has_a_large_share():
    found = interaction(evidence(errors(4, (10, 25, 4), suits=0.5, policy=0.2, person=0.2)))
    assert found.ci95[0] < 25 / 29 < found.ci95[1]


def pairs(seed, count, own=1.0):
    """Return the errors of pairs that are ``own`` times as large with their own partners."""
    rng = np.random.default_rng(seed)
    logs = 0.2 * rng.standard_normal((count, 1)) + 0.2 * rng.standard_normal((1, count))
    return np.exp(logs + 0.3 * rng.standard_normal((count, count)) + np.eye(count) * math.log(own))


@pytest.mark.parametrize("count", [3, 4, 8])
def test_pairs_without_conventions_pass_at_most_one_time_in_twenty(count):
    passed = [conventions(pairs(seed, count)).passed for seed in range(1000)]
    assert np.mean(passed) <= 0.05


def test_pairs_that_do_better_with_others_fail():
    assert conventions(np.array([[4.0, 2, 2], [2, 4, 2], [2, 2, 4]])).passed is False


def test_pairs_with_conventions_pass():
    found = conventions(pairs(1, 6, own=0.3))
    assert found.passed
    assert found.ci95[0] < found.figure < found.ci95[1]


def test_without_pairs_nothing_is_compared():
    assert conventions(None).passed is None


def test_a_task_without_a_published_figure_is_not_compared():
    found = like_people(None, "nothing was published")
    assert (found.passed, found.detail) == (None, "nothing was published")


@pytest.mark.parametrize(("spread", "passed"), [(0.001, True), (0.2, False)])
def test_the_whole_interval_must_be_in_the_published_one(spread, passed):
    published = PUBLISHED["intent"]
    middle = (published.low + published.high) / 2
    left = tuple(middle + spread * math.sin(i) for i in range(25))
    compared = Compared(published=published, figure=middle, without_person=left)
    assert like_people(compared, "").passed is passed


def test_acting_alone_costs_what_it_costs():
    values = errors(5, (3, 12, 4)) * np.array([1.0, 3.0, 4.0])[:, None, None]
    found = needs_partner(evidence(values, alone=("policy1", "policy2")))
    assert found.passed
    assert found.figure == pytest.approx(3.0, rel=0.2)
    assert found.ci95[0] < found.figure < found.ci95[1]


def test_where_the_best_robot_acts_alone_nothing_is_needed():
    found = needs_partner(evidence(errors(6, (3, 12, 4)), alone=("policy0", "policy1", "policy2")))
    assert (found.figure, found.passed) == (pytest.approx(1.0), False)


@pytest.mark.parametrize(("two_people", "passed"), [(10.0, True), (90.0, False)])
def test_standing_still_must_cost_more_than_two_people(two_people, passed):
    assert no_free_ride(evidence(errors(7, (3, 12, 4)), two_people=two_people)).passed is passed


def test_a_drop_by_two_people_must_not_be_the_worst():
    assert not no_free_ride(evidence(errors(8, (3, 12, 4)), idle=900.0, two_people=260.0)).passed


def suited(scale):
    """Return errors with one straw man: good with every other person, bad with the others."""
    values = errors(9, (6, 12, 4), noise=0.05)
    values[0] *= np.exp(scale * np.resize([-1.0, 1.0], 12))[:, None]
    return values


def test_what_hangs_on_one_policy_is_named():
    some = evidence(suited(0.5))
    found = [rank_changes(some)]
    assert found[0].passed
    judged = with_fragility(some, (*found, *others(some)))
    assert {each.letter: each.hangs_on for each in judged if each.hangs_on} == {"c": ("policy0",)}
    assert [each.verdict for each in judged if each.hangs_on] == ["undecided"]
    assert [each.doubt for each in judged if each.doubt] == ["it fails without policy0"]


def test_what_hangs_on_any_of_several_says_so():
    some = rank_changes(evidence(suited(0.5)))
    hanging = replace(some, passed=False, hangs_on=("copy", "level", "draw-3"))
    assert hanging.verdict == "undecided"
    assert hanging.doubt == "it passes without any one of copy, level and draw-3"
    assert some.doubt == ""


def others(some):
    """Return the other criteria of the errors."""
    return needs_partner(some), interaction(some), no_free_ride(some)


def test_where_all_policies_suit_somebody_nothing_hangs_on_one():
    some = evidence(errors(10, (10, 25, 4), suits=0.8), alone=("policy0", "policy1"))
    judged = with_fragility(some, (rank_changes(some), *others(some)))
    assert not any(each.hangs_on for each in judged)
    assert judged[0].verdict == "passed"
