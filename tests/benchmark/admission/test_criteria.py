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
from colift.benchmark.admission.fragility import judged
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


def test_an_interaction_of_one_policy_alone_is_not_beyond_its_noise():
    values = errors(0, (6, 40, 4), person=0.05)
    values[0] *= np.exp(np.random.default_rng(100).standard_normal((40, 1)))
    found = interaction(evidence(values))
    assert 0.2 < found.ci95[0] <= found.ci95[1] <= 1.0
    assert not found.passed
    assert found.detail.endswith("is not beyond its noise")


def pairs(seed, count, own=1.0):
    """Return the errors of pairs that are ``own`` times as large with their own partners."""
    rng = np.random.default_rng(seed)
    logs = 0.2 * rng.standard_normal((count, 1)) + 0.2 * rng.standard_normal((1, count))
    return np.exp(logs + 0.3 * rng.standard_normal((count, count)) + np.eye(count) * math.log(own))


@pytest.mark.parametrize("count", [3, 4, 8])
def test_pairs_without_conventions_pass_at_most_one_time_in_twenty(count):
    passed = [conventions(evidence(pairs=pairs(seed, count))).passed for seed in range(1000)]
    assert np.mean(passed) <= 0.05


def test_pairs_that_do_better_with_others_fail():
    assert (
        conventions(evidence(pairs=np.array([[4.0, 2, 2], [2, 4, 2], [2, 2, 4]]))).passed is False
    )


def test_pairs_with_conventions_pass():
    found = conventions(evidence(pairs=pairs(1, 6, own=0.3)))
    assert found.passed
    assert found.ci95[0] < found.figure < found.ci95[1]


def test_without_pairs_nothing_is_compared():
    assert conventions(evidence()).passed is None


def test_a_task_without_a_published_figure_is_not_compared():
    found = like_people(evidence(not_compared="nothing was published"))
    assert (found.passed, found.detail) == (None, "nothing was published")


@pytest.mark.parametrize(("spread", "passed"), [(0.001, True), (0.2, False)])
def test_the_whole_interval_must_be_in_the_published_one(spread, passed):
    published = PUBLISHED["intent"]
    assert like_people(evidence(compared=compared(published, spread))).passed is passed


def compared(published, spread, *, odd=None):
    """Return a comparison of 25 people; the figure is far off with the odd one."""
    people = tuple(f"draw-{i}" for i in range(25))
    middle = (published.low + published.high) / 2

    def measured(left_out):
        away = sum(math.sin(people.index(each)) for each in left_out)
        return middle + spread * away + (10.0 if odd and odd not in left_out else 0.0)

    return Compared(published=published, measured=measured, people=people)


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


def hanging(some):
    """Return what decides each of the criteria that one decides."""
    return {each.letter: each.hangs_on for each in judged(some) if each.hangs_on}


def test_what_hangs_on_one_policy_is_named():
    some = evidence(suited(0.5))
    assert rank_changes(some).passed
    assert hanging(some) == {"c": ("policy0",)}
    found = next(each for each in judged(some) if each.letter == "c")
    assert (found.verdict, found.doubt) == ("undecided", "it fails without policy0")


def test_what_hangs_on_one_pair_is_named():
    """One pair alone understands the others no worse than itself."""
    errors = pairs(1, 4, own=0.3)
    errors[2, 2] = errors.max()
    some = evidence(pairs=errors)
    assert not conventions(some).passed
    assert hanging(some) == {"d": ("pair 3",)}


def test_what_hangs_on_one_person_is_named():
    odd = compared(PUBLISHED["intent"], 0.001, odd="draw-7")
    some = evidence(errors(11, (3, 25, 4)), compared=odd)
    assert not like_people(some).passed
    assert hanging(some) == {"e": ("draw-7",)}


def test_what_hangs_on_any_of_several_says_so():
    some = rank_changes(evidence(suited(0.5)))
    hanging = replace(some, passed=False, hangs_on=("copy", "level", "draw-3"))
    assert hanging.verdict == "undecided"
    assert hanging.doubt == "it passes without any one of copy, level and draw-3"
    assert some.doubt == ""


def test_where_all_policies_suit_somebody_nothing_hangs_on_one():
    some = evidence(errors(10, (10, 25, 4), suits=0.8), alone=("policy0", "policy1"))
    assert hanging(some) == {}
    assert {each.letter: each.verdict for each in judged(some)}["c"] == "passed"
