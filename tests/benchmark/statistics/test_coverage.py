"""A 95 % interval contains the true value in 95 % of the data sets, cell means being fixed."""

from collections.abc import Callable

import numpy as np
import pytest
from colift.benchmark.results.baselines import shipped_baselines
from colift.benchmark.statistics import (
    paired_difference,
    ratio_of_means,
    stratified_bootstrap,
)
from colift.benchmark.suites.suite import make_suite
from numpy.typing import NDArray

Sample = NDArray[np.float64]
Draw = Callable[[np.random.Generator, tuple[int, int]], Sample]
Find = Callable[[Sample, Sample, list[int], int], tuple[float, float]]

DRAWS = 4
"""Seeds of the resampling that the data sets have in turn: the draws of so many are kept."""


def normal(rng: np.random.Generator, shape: tuple[int, int]) -> Sample:
    return rng.normal(0.0, 1.0, shape)


def lognormal(rng: np.random.Generator, shape: tuple[int, int]) -> Sample:
    return rng.lognormal(0.0, 0.5, shape) - np.exp(0.125)


def coverage(
    cells: int,
    episodes: int,
    draw: Draw,
    *,
    stratified: bool = True,
    confidence: float = 0.95,
    sets: int = 1000,
) -> float:
    """Return the share of simulated data sets whose interval contains the true mean."""
    rng = np.random.default_rng(0)
    means = 10.0 + np.linspace(0.0, 5.0, cells)
    strata = [cell if stratified else 0 for cell in range(cells) for _ in range(episodes)]
    hits = 0
    for number in range(sets):
        values = (means[:, None] + draw(rng, (cells, episodes))).ravel()
        low, high = stratified_bootstrap(
            values, strata, resamples=600, confidence=confidence, seed=number % DRAWS
        )
        hits += low <= means.mean() <= high
    return hits / sets


@pytest.mark.parametrize("draw", [normal, lognormal])
def test_of_the_standard_suite_with_twenty_cells_of_fifteen(draw: Draw) -> None:
    assert 0.93 <= coverage(20, 15, draw) <= 0.97


def shipped(name: str) -> Sample:
    """Return the errors of a reference on the standard suite, shape (20, 15).

    They are the population of each cell, of which fifteen lifts are drawn.
    """
    reference = (shipped_baselines(make_suite("standard-v1")) or {})[name]
    return np.reshape(reference.rmse_mm, (20, 15))


@pytest.mark.parametrize("name", ["human_human", "copy"])
def test_of_the_standard_suite_with_errors_as_they_are(name: str) -> None:
    cells = shipped(name)

    def draw(rng: np.random.Generator, shape: tuple[int, int]) -> Sample:
        chosen = rng.integers(0, 15, shape)
        return np.take_along_axis(cells, chosen, axis=1) - cells.mean(axis=1, keepdims=True)

    assert 0.93 <= coverage(20, 15, draw) <= 0.97


def paired_coverage(find: Find, true: float, *, sets: int = 1000) -> float:
    """Return the share of drawn pairs of policies whose interval contains the true value."""
    rng = np.random.default_rng(0)
    a, b = shipped("copy"), shipped("human_human")
    strata = np.repeat(np.arange(20), 15).tolist()
    hits = 0
    for number in range(sets):
        chosen = rng.integers(0, 15, (20, 15))
        x, y = (np.take_along_axis(cells, chosen, axis=1).ravel() for cells in (a, b))
        low, high = find(x, y, strata, number % DRAWS)
        hits += low <= true <= high
    return hits / sets


def ratio(confidence: float) -> Find:
    return lambda a, b, strata, seed: (
        ratio_of_means(a, b, strata, resamples=600, confidence=confidence, seed=seed).ci95
    )


def test_of_the_ratio_to_the_human_human_baseline() -> None:
    true = shipped("copy").mean() / shipped("human_human").mean()
    assert 0.93 <= paired_coverage(ratio(0.95), true) <= 0.97
    assert paired_coverage(ratio(0.9), true, sets=400) < 0.93
    assert paired_coverage(ratio(0.95), 1.01 * true, sets=400) < 0.93


def test_of_the_paired_difference_to_the_human_human_baseline() -> None:
    def find(a: Sample, b: Sample, strata: list[int], seed: int) -> tuple[float, float]:
        return paired_difference(a, b, strata, resamples=600, seed=seed).ci95

    true = shipped("copy").mean() - shipped("human_human").mean()
    assert 0.93 <= paired_coverage(find, true) <= 0.97
    assert paired_coverage(find, true + 0.2, sets=400) < 0.93


@pytest.mark.parametrize("draw", [normal, lognormal])
def test_of_four_cells_of_fifteen(draw: Draw) -> None:
    assert 0.93 <= coverage(4, 15, draw, sets=3000) <= 0.97


def test_of_small_cells_in_which_plain_percentiles_would_cover_88_percent() -> None:
    assert 0.93 <= coverage(20, 3, normal, sets=3000) <= 0.97


def test_the_check_notices_an_interval_that_is_too_narrow_or_too_wide() -> None:
    assert coverage(20, 15, normal, confidence=0.9, sets=400) < 0.93
    assert coverage(20, 15, normal, stratified=False, sets=400) > 0.97
