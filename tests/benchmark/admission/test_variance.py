"""Shares of variance, on tables of which they are known."""

import numpy as np
import pytest
from colift.base.errors import InputError
from colift.benchmark.admission.variance import variance_shares

LIFTS = np.zeros((1, 1, 4))


def of(table):
    """Return the shares of errors with these logarithms and no noise."""
    return variance_shares(np.exp(np.asarray(table, dtype=float)[..., np.newaxis] + LIFTS))


def test_policies_that_differ_with_everybody_alike_have_no_interaction():
    shares = of(np.add.outer([1.0, 2.0, 4.0], [0.0, 0.5]))
    assert shares.interaction == pytest.approx(0.0, abs=1e-12)
    assert shares.policy + shares.person == pytest.approx(1.0)


def test_policies_that_each_suit_one_person_have_hardly_anything_else():
    assert of(np.eye(6)).interaction == pytest.approx(1.0)


def test_people_alone():
    assert of([[1.0, 2.0], [1.0, 2.0]]).person == pytest.approx(1.0)


def test_of_what_people_change_the_means_of_policies_are_no_part():
    table = 0.5 * np.eye(6) + np.arange(6.0)[:, np.newaxis]
    assert of(table).interaction < 0.1
    assert of(table).between_people == pytest.approx(1.0)


def test_the_noise_of_lifts_and_what_a_behaviour_asks_for_are_no_interaction():
    rng = np.random.default_rng(1)
    found = []
    for _ in range(40):
        logs = rng.standard_normal((6, 12, 4)) * 0.5 + rng.standard_normal((6, 1, 4))
        found.append(variance_shares(np.exp(logs + rng.standard_normal((1, 12, 1)))).interaction)
    assert abs(np.mean(found)) < 0.02


def test_the_share_is_that_of_the_population():
    rng = np.random.default_rng(2)
    found = []
    for _ in range(40):
        logs = rng.standard_normal((12, 25, 1)) + rng.standard_normal((12, 1, 1))
        logs = logs + rng.standard_normal((1, 25, 1)) + 2 * rng.standard_normal((12, 25, 4))
        found.append(variance_shares(np.exp(logs)).interaction)
    assert np.mean(found) == pytest.approx(1 / 3, abs=0.04)


@pytest.mark.parametrize("shape", [(1, 2, 2), (2, 1, 2), (2, 2, 1), (2, 2)])
def test_what_has_no_shares_is_refused(shape):
    with pytest.raises(InputError, match="shares need 2 policies, people and lifts or more"):
        variance_shares(np.ones(shape))
