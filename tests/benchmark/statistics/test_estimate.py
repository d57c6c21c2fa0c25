"""Means, ratios and differences with their intervals between people."""

import math

import numpy as np
import pytest
from colift.base.errors import InputError
from colift.benchmark.statistics import (
    Units,
    difference_of_means,
    geometric_ratio,
    mean_of,
    paired_difference,
    ratio_of_means,
)

T_24 = 2.0639


def people(number: int, ways: int = 4) -> Units:
    return Units.people((way, person) for person in range(number) for way in range(ways))


def width(estimate) -> float:
    low, high = estimate.ci95
    return high - low


class TestMean:
    rng = np.random.default_rng(1)
    values = (20.0 + rng.normal(0.0, 2.0, (25, 1)) + rng.normal(0.0, 1.0, (25, 4))).ravel()

    def test_is_the_t_interval_of_the_means_of_people_on_a_log_scale(self) -> None:
        means = self.values.reshape(25, 4).mean(axis=1)
        error = means.std(ddof=1) / 5
        found = mean_of(self.values, people(25))
        assert found.mean == pytest.approx(means.mean())
        for end, sign in zip(found.ci95, (-1, 1), strict=True):
            expected = means.mean() * math.exp(sign * T_24 * error / means.mean())
            assert end == pytest.approx(expected, rel=1e-5)

    def test_of_values_of_both_signs_is_symmetric(self) -> None:
        found = mean_of(self.values - 20.0, people(25))
        assert sum(found.ci95) / 2 == pytest.approx(found.mean)

    def test_never_contains_an_error_below_zero(self) -> None:
        assert mean_of([0.1, 0.1, 50.0], people(3, 1)).ci95[0] > 0.0

    def test_rejects_a_missing_value(self) -> None:
        with pytest.raises(InputError, match=r"values\[1\] is nan; it must be a number for each"):
            mean_of([1.0, math.nan], people(2, 1))
        with pytest.raises(InputError, match="values has shape"):
            mean_of([], people(1))


class TestGeometricRatio:
    rng = np.random.default_rng(2)
    difficulty = rng.lognormal(2.0, 0.4, 100)
    robot = 1.5 * difficulty * rng.lognormal(0.0, 0.05, 100)

    def test_counts_easy_and_difficult_lifts_alike(self) -> None:
        found = geometric_ratio([1.0, 90.0], [2.0, 45.0], people(2, 1))
        assert found.mean == pytest.approx(1.0)

    def test_of_the_reverse_is_the_reciprocal(self) -> None:
        forth = geometric_ratio(self.robot, self.difficulty, people(25))
        back = geometric_ratio(self.difficulty, self.robot, people(25))
        assert back.mean == pytest.approx(1 / forth.mean)
        assert back.ci95 == pytest.approx((1 / forth.ci95[1], 1 / forth.ci95[0]))

    def test_pairing_removes_what_both_have_in_common(self) -> None:
        shuffled = np.random.default_rng(3).permutation(100)
        paired = geometric_ratio(self.robot, self.difficulty, people(25))
        unpaired = geometric_ratio(self.robot, self.difficulty[shuffled], people(25))
        assert width(paired) < 0.3 * width(unpaired)

    def test_an_error_of_zero_has_a_ratio(self) -> None:
        found = geometric_ratio([0.0, 5.0], [5.0, 0.0], people(2, 1))
        assert found.mean == pytest.approx(1.0)
        assert all(map(math.isfinite, found.ci95))

    def test_rejects_a_negative_error_and_unequal_lengths(self) -> None:
        with pytest.raises(InputError, match=r"denominator\[1\] is -1\.0; a ratio needs errors"):
            geometric_ratio([1.0, 1.0], [1.0, -1.0], people(2, 1))
        with pytest.raises(InputError, match="numerator has 2 episodes, denominator 1"):
            geometric_ratio([1.0, 1.0], [1.0], people(2, 1))


class TestRatioOfMeans:
    def test_is_the_ratio_of_means_not_the_mean_of_ratios(self) -> None:
        found = ratio_of_means([1.0, 9.0] * 40, [1.0, 3.0] * 40, people(80, 1))
        assert found.mean == 10 / 4
        assert 2.0 < found.ci95[0] < found.mean < found.ci95[1]

    def test_of_proportional_values_is_exact(self) -> None:
        values = np.random.default_rng(0).lognormal(2.0, 0.4, 60)
        found = ratio_of_means(0.5 * values, values, people(15)).ci95
        assert found == pytest.approx((0.5, 0.5))

    def test_rejects_a_denominator_that_is_not_positive(self) -> None:
        with pytest.raises(InputError, match=r"denominator 0\.0 of episode 1"):
            ratio_of_means([1.0, 1.0], [1.0, 0.0], people(2, 1))


class TestPairedDifference:
    rng = np.random.default_rng(4)
    a = rng.normal(20.0, 5.0, 60)
    b = a - 1.0 + rng.normal(0.0, 0.5, 60)
    units = people(15)

    def test_finds_a_small_difference_under_a_large_common_spread(self) -> None:
        difference = paired_difference(self.a, self.b, self.units)
        low, high = difference.ci95
        assert difference.mean == pytest.approx(np.mean(self.a) - np.mean(self.b))
        assert 0.0 < low < 1.0 < high

    def test_changes_sign_with_the_order(self) -> None:
        forth = paired_difference(self.a, self.b, self.units)
        back = paired_difference(self.b, self.a, self.units)
        assert back.mean == -forth.mean
        assert back.ci95 == pytest.approx((-forth.ci95[1], -forth.ci95[0]))

    def test_of_equal_policies_is_zero(self) -> None:
        difference = paired_difference(self.a, self.a, self.units)
        assert (difference.mean, difference.ci95) == (0.0, (0.0, 0.0))


class TestDifferenceOfMeans:
    """Two sets of people that have nothing in common: the variances add up."""

    rng = np.random.default_rng(4)
    a, b = 12.0 + rng.normal(0.0, 2.0, 60), 10.0 + rng.normal(0.0, 1.0, 30)

    def test_agrees_with_welch(self) -> None:
        found = difference_of_means(self.a, people(60, 1), self.b, people(30, 1))
        error = math.sqrt(self.a.var(ddof=1) / 60 + self.b.var(ddof=1) / 30)
        assert width(found) / 2 == pytest.approx(1.99 * error, rel=0.01)
        assert found.mean == pytest.approx(self.a.mean() - self.b.mean())

    def test_of_one_person_has_no_interval(self) -> None:
        assert difference_of_means(self.a, people(60, 1), self.b, people(1, 30)).ci95 is None

    def test_refuses_a_missing_value(self) -> None:
        with pytest.raises(InputError, match=r"b\[0\] is nan"):
            difference_of_means([1.0], people(1, 1), [math.nan], people(1, 1))
