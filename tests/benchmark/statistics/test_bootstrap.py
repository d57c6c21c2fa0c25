import math

import numpy as np
import pytest
from colift.base.errors import InputError
from colift.benchmark.statistics import (
    difference_of_means,
    interquartile_mean,
    paired_difference,
    ratio_of_means,
    stratified_bootstrap,
)


def labels(cells: int, episodes: int) -> list[tuple[str, int]]:
    return [("cell", cell) for cell in range(cells) for _ in range(episodes)]


class TestStratifiedBootstrap:
    means = 10.0 + np.linspace(0.0, 5.0, 4)
    values = (means[:, None] + np.random.default_rng(1).normal(0.0, 1.0, (4, 15))).ravel()
    strata = labels(4, 15)

    def test_of_the_mean_agrees_with_the_t_interval_within_cells(self) -> None:
        cells = self.values.reshape(4, 15)
        standard_error = math.sqrt(cells.var(axis=1, ddof=1).mean() / 60)
        low, high = stratified_bootstrap(self.values, self.strata, np.mean, resamples=20000)
        t_56 = 2.0032
        assert (high - low) / 2 == pytest.approx(t_56 * standard_error, rel=0.03)
        assert (high + low) / 2 == pytest.approx(cells.mean(), abs=0.1 * standard_error)

    def test_differences_between_cells_add_no_width(self) -> None:
        stratified = stratified_bootstrap(self.values, self.strata, np.mean)
        pooled = stratified_bootstrap(self.values, ["all"] * 60, np.mean)
        assert np.ptp(stratified) < 0.7 * np.ptp(pooled)

    def test_never_draws_across_cells(self) -> None:
        assert stratified_bootstrap([1.0, 1.0, 5.0, 5.0], ["a", "a", "b", "b"], np.mean) == (3, 3)

    def test_the_order_of_episodes_does_not_tie_them_to_cells(self) -> None:
        interleaved = stratified_bootstrap([1.0, 5.0, 1.0, 5.0], ["a", "b", "a", "b"], np.mean)
        assert interleaved == (3.0, 3.0)

    def test_the_seed_decides(self) -> None:
        first = stratified_bootstrap(self.values, self.strata, np.mean, seed=3)
        assert stratified_bootstrap(self.values, self.strata, np.mean, seed=3) == first
        assert stratified_bootstrap(self.values, self.strata, np.mean, seed=4) != first

    def test_takes_any_statistic(self) -> None:
        low, high = stratified_bootstrap(self.values, self.strata, interquartile_mean)
        assert low < interquartile_mean(self.values) < high

    def test_more_confidence_is_wider(self) -> None:
        widths = [
            np.ptp(stratified_bootstrap(self.values, self.strata, np.mean, confidence=level))
            for level in (0.5, 0.8, 0.95, 0.99)
        ]
        assert widths == sorted(widths)
        assert widths[0] > 0

    def test_a_cell_of_one_episode_stays_as_it_is(self) -> None:
        assert stratified_bootstrap([7.0], ["a"], np.mean) == (7.0, 7.0)
        assert stratified_bootstrap([2.0, 4.0], ["a", "b"], np.mean) == (3.0, 3.0)
        many = stratified_bootstrap(self.values, self.strata, np.sum)
        and_one = stratified_bootstrap([*self.values, 9.0], [*self.strata, "one"], np.sum)
        assert np.subtract(and_one, many) == pytest.approx([9.0, 9.0])

    def test_rejects_what_it_cannot_resample(self) -> None:
        with pytest.raises(InputError, match=r"values\[1\] is nan; it must be a number for each"):
            stratified_bootstrap([1.0, math.nan], ["a", "a"], np.mean)
        with pytest.raises(InputError, match="strata has 3 labels"):
            stratified_bootstrap([1.0, 2.0], ["a", "a", "b"], np.mean)
        with pytest.raises(InputError, match="values has shape"):
            stratified_bootstrap([], [], np.mean)
        with pytest.raises(InputError, match="confidence is 95"):
            stratified_bootstrap([1.0, 2.0], ["a", "a"], np.mean, confidence=95)


class TestRatioOfMeans:
    rng = np.random.default_rng(2)
    difficulty = rng.lognormal(2.0, 0.4, 60)
    robot = 1.5 * difficulty + rng.normal(0.0, 0.3, 60)
    strata = labels(4, 15)

    def test_contains_the_ratio_of_means_not_the_mean_of_ratios(self) -> None:
        estimate = ratio_of_means([1.0, 9.0] * 40, [1.0, 3.0] * 40, ["a"] * 80)
        mean_of_ratios = (1 + 3) / 2
        assert estimate.mean == 10 / 4
        assert mean_of_ratios < estimate.ci95[0] < estimate.mean < estimate.ci95[1]

    def test_pairing_removes_what_both_have_in_common(self) -> None:
        within = np.arange(60).reshape(4, 15)
        shuffled = np.random.default_rng(3).permuted(within, axis=1).ravel()
        paired = ratio_of_means(self.robot, self.difficulty, self.strata).ci95
        unpaired = ratio_of_means(self.robot, self.difficulty[shuffled], self.strata).ci95
        assert paired[0] < self.robot.mean() / self.difficulty.mean() < paired[1]
        assert np.ptp(paired) < 0.3 * np.ptp(unpaired)

    def test_of_proportional_values_is_exact(self) -> None:
        interval = ratio_of_means(0.5 * self.difficulty, self.difficulty, self.strata).ci95
        assert interval == pytest.approx((0.5, 0.5))

    def test_the_seed_decides(self) -> None:
        first = ratio_of_means(self.robot, self.difficulty, self.strata, seed=1)
        assert ratio_of_means(self.robot, self.difficulty, self.strata, seed=1) == first
        assert ratio_of_means(self.robot, self.difficulty, self.strata, seed=2) != first

    def test_rejects_a_denominator_that_is_not_positive_and_unequal_lengths(self) -> None:
        with pytest.raises(InputError, match=r"denominator 0\.0 of episode 1"):
            ratio_of_means([1.0, 1.0], [1.0, 0.0], ["a", "a"])
        with pytest.raises(InputError, match="numerator has 2 episodes, denominator 1"):
            ratio_of_means([1.0, 1.0], [1.0], ["a", "a"])


class TestPairedDifference:
    rng = np.random.default_rng(4)
    a = rng.normal(20.0, 5.0, 60)
    b = a - 1.0 + rng.normal(0.0, 0.5, 60)
    strata = labels(4, 15)

    def test_finds_a_small_difference_under_a_large_common_spread(self) -> None:
        difference = paired_difference(self.a, self.b, self.strata)
        low, high = difference.ci95
        assert difference.mean == pytest.approx(np.mean(self.a) - np.mean(self.b))
        assert 0.0 < low < difference.mean < high
        assert low < 1.0 < high

    def test_changes_sign_with_the_order(self) -> None:
        forth, back = (
            paired_difference(x, y, self.strata, resamples=20000)
            for x, y in ((self.a, self.b), (self.b, self.a))
        )
        assert back.mean == -forth.mean
        assert back.ci95 == pytest.approx((-forth.ci95[1], -forth.ci95[0]))

    def test_of_equal_policies_is_zero(self) -> None:
        difference = paired_difference(self.a, self.a, self.strata)
        assert (difference.mean, difference.ci95) == (0.0, (0.0, 0.0))


class TestDifferenceOfMeans:
    """Two sets of episodes that have nothing in common: the variances add up."""

    rng = np.random.default_rng(4)
    a, b = 12.0 + rng.normal(0.0, 2.0, 60), 10.0 + rng.normal(0.0, 1.0, 30)
    strata_a, strata_b = labels(4, 15), labels(2, 15)

    def interval(self, confidence: float = 0.95) -> tuple[float, float]:
        return difference_of_means(
            self.a, self.strata_a, self.b, self.strata_b, resamples=20000, confidence=confidence
        ).ci95

    def test_agrees_with_the_normal_interval(self) -> None:
        variances = [
            x.reshape(-1, 15).var(axis=1, ddof=1).mean() / x.size for x in (self.a, self.b)
        ]
        low, high = self.interval()
        assert (high - low) / 2 == pytest.approx(1.99 * math.sqrt(sum(variances)), rel=0.03)
        assert (high + low) / 2 == pytest.approx(self.a.mean() - self.b.mean(), abs=0.03)

    def test_cells_of_equal_names_are_not_one(self) -> None:
        """Constant cells that shared a name would be mixed, and vary."""
        interval = difference_of_means([5.0, 5.0], ["x", "x"], [2.0, 2.0], ["x", "x"]).ci95
        assert interval == (3.0, 3.0)

    def test_covers_the_true_difference_in_95_percent(self) -> None:
        rng = np.random.default_rng(5)
        strata = labels(3, 6)
        hits = 0
        for seed in range(1000):
            a, b = rng.normal(1.0, 1.0, 18), rng.normal(0.0, 2.0, 18)
            low, high = difference_of_means(a, strata, b, strata, resamples=400, seed=seed).ci95
            hits += low <= 1.0 <= high
        assert 0.93 <= hits / 1000 <= 0.97

    def test_refuses_a_missing_value(self) -> None:
        with pytest.raises(InputError, match=r"b\[0\] is nan"):
            difference_of_means([1.0], ["x"], [math.nan], ["x"])
