"""The paired sign-flip test."""

import numpy as np
import pytest
from colift.agents.errors import InputError
from colift.benchmark.statistics import paired_permutation_p


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
