"""The paired sign-flip test, by people."""

import itertools

import numpy as np
import pytest
from colift.base.errors import InputError
from colift.benchmark.statistics import Units, paired_permutation_p
from colift.benchmark.statistics.permutation import far_apart


def single(number: int) -> Units:
    return Units.episodes(["all"] * number)


def test_five_differences_of_one_sign_have_p_of_one_sixteenth():
    a = np.array([1.0, 2.0, 3.0, 4.0, 5.0])
    p = paired_permutation_p(a, a - [0.5, 0.6, 0.7, 0.8, 0.9], single(5))
    assert p == 2 / 2**5


def test_lifts_of_five_people_have_no_more_than_thirty_two_signs():
    units = Units.people((way, person) for person in range(5) for way in range(20))
    assert paired_permutation_p(np.ones(100), np.zeros(100), units) == 2 / 2**5
    assert paired_permutation_p(np.ones(100), np.zeros(100), single(100)) < 0.001


def test_no_difference_has_p_of_one():
    assert paired_permutation_p([1.0, 2.0], [1.0, 2.0], single(2)) == 1.0


def test_the_order_of_the_two_does_not_matter():
    rng = np.random.default_rng(0)
    a, b = rng.normal(size=30), rng.normal(0.4, size=30)
    assert paired_permutation_p(a, b, single(30)) == paired_permutation_p(b, a, single(30))


def test_p_is_never_below_what_the_resamples_can_tell():
    a = np.arange(40.0) + 5
    assert paired_permutation_p(a, np.arange(40.0), single(40), resamples=99) == 0.01


@pytest.mark.parametrize("people", [12, 30])
def test_p_is_uniform_when_there_is_nothing_to_find(people):
    rng = np.random.default_rng(1)
    units = single(people)
    ps = [
        paired_permutation_p(rng.normal(size=people), rng.normal(size=people), units)
        for _ in range(400)
    ]
    assert np.mean(np.array(ps) < 0.1) == pytest.approx(0.1, abs=0.04)


def test_a_missing_value_is_refused():
    with pytest.raises(InputError, match=r"a\[1\] is nan"):
        paired_permutation_p([1.0, np.nan], [1.0, 2.0], single(2))


@pytest.mark.parametrize("p", [0.05, 0.01, 1e-3, 1e-4])
@pytest.mark.parametrize("seed", range(6))
def test_beyond_the_bound_every_exact_p_value_is_below(p: float, seed: int) -> None:
    """Of all signs of sixteen differences of whatever sizes."""
    rng = np.random.default_rng(seed)
    signs = np.array(list(itertools.product((-1.0, 1.0), repeat=16)))
    d = rng.gamma(0.5 if seed % 2 else 20.0, 1.0, 16)
    least = far_apart(p) * np.sqrt((d**2).sum())
    assert (np.abs(signs @ d) >= least).mean() <= p
