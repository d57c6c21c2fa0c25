"""The paired sign-flip test."""

import itertools

import numpy as np
import pytest
from colift.base.errors import InputError
from colift.benchmark.statistics import paired_permutation_p, permutation_ps_against
from colift.benchmark.statistics.permutation import far_apart, sequential_permutation_ps


def test_five_differences_of_one_sign_have_p_of_one_sixteenth():
    a = np.array([1.0, 2.0, 3.0, 4.0, 5.0])
    p = paired_permutation_p(a, a - [0.5, 0.6, 0.7, 0.8, 0.9], resamples=40_000)
    assert p == pytest.approx(2 / 2**5, abs=0.005)


def test_no_difference_has_p_of_one():
    assert paired_permutation_p([1.0, 2.0], [1.0, 2.0]) == 1.0


def test_the_order_of_the_two_does_not_matter():
    rng = np.random.default_rng(0)
    a, b = rng.normal(size=30), rng.normal(0.4, size=30)
    assert paired_permutation_p(a, b) == paired_permutation_p(b, a)


def test_p_is_never_below_what_the_resamples_can_tell():
    assert paired_permutation_p(np.arange(40.0) + 5, np.arange(40.0), resamples=99) == 0.01


def test_p_is_uniform_when_there_is_nothing_to_find():
    rng = np.random.default_rng(1)
    ps = [
        paired_permutation_p(rng.normal(size=12), rng.normal(size=12), resamples=400)
        for _ in range(400)
    ]
    assert np.mean(np.array(ps) < 0.1) == pytest.approx(0.1, abs=0.04)


def test_a_missing_value_is_refused():
    with pytest.raises(InputError, match=r"a\[1\] is nan"):
        paired_permutation_p([1.0, np.nan], [1.0, 2.0])


def test_a_sequential_p_is_the_plain_one_if_all_flips_are_made_and_near_it_if_not() -> None:
    rng = np.random.default_rng(2)
    differences = rng.normal(0.0, 1.0, (40, 60)) + np.linspace(0.0, 0.6, 40)[:, None]
    zero = np.zeros(60)
    plain = np.array(permutation_ps_against(zero, list(-differences)))
    found = sequential_permutation_ps(differences)
    few = plain < 0.05
    assert 5 < few.sum() < 35
    assert (found[few] == plain[few]).all()
    assert found[~few] == pytest.approx(plain[~few], rel=0.4)
    assert (found[~few] > 0.05).all()


def test_more_flips_than_one_draw_give_smaller_p_values_to_those_who_need_them() -> None:
    differences = np.stack((np.ones(40), np.zeros(40)))
    found = sequential_permutation_ps(differences, resamples=30_000)
    assert found[0] == pytest.approx(1 / 30_001)
    assert found[1] == 1.0


@pytest.mark.parametrize("p", [0.05, 0.01, 1e-3, 1e-4])
@pytest.mark.parametrize("seed", range(6))
def test_beyond_the_bound_every_exact_p_value_is_below(p: float, seed: int) -> None:
    """Of all signs of sixteen differences of whatever sizes."""
    rng = np.random.default_rng(seed)
    signs = np.array(list(itertools.product((-1.0, 1.0), repeat=16)))
    d = rng.gamma(0.5 if seed % 2 else 20.0, 1.0, 16)
    least = far_apart(p) * np.sqrt((d**2).sum())
    assert (np.abs(signs @ d) >= least).mean() <= p
