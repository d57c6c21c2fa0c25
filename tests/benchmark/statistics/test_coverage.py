"""A 95 % interval contains the true mean in 95 % of the data sets, cell means being fixed."""

from collections.abc import Callable

import numpy as np
import pytest
from colift.benchmark.references import shipped_references
from colift.benchmark.statistics import stratified_bootstrap
from colift.benchmark.suite import make_suite
from numpy.typing import NDArray

Sample = NDArray[np.float64]
Draw = Callable[[np.random.Generator, tuple[int, int]], Sample]


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
    for seed in range(sets):
        values = (means[:, None] + draw(rng, (cells, episodes))).ravel()
        low, high = stratified_bootstrap(
            values, strata, resamples=600, confidence=confidence, seed=seed
        )
        hits += low <= means.mean() <= high
    return hits / sets


@pytest.mark.parametrize("draw", [normal, lognormal])
def test_of_the_standard_suite_with_twenty_cells_of_fifteen(draw: Draw) -> None:
    assert 0.93 <= coverage(20, 15, draw) <= 0.97


@pytest.mark.parametrize("name", ["human_human", "copy"])
def test_of_the_standard_suite_with_errors_as_they_are(name: str) -> None:
    """The shipped errors of each cell are the population that its fifteen lifts are drawn from."""
    reference = (shipped_references(make_suite("standard-v1")) or {})[name]
    cells = np.reshape(reference.rmse_mm, (20, 15))

    def draw(rng: np.random.Generator, shape: tuple[int, int]) -> Sample:
        chosen = rng.integers(0, 15, shape)
        return np.take_along_axis(cells, chosen, axis=1) - cells.mean(axis=1, keepdims=True)

    assert 0.93 <= coverage(20, 15, draw) <= 0.97


@pytest.mark.parametrize("draw", [normal, lognormal])
def test_of_four_cells_of_fifteen(draw: Draw) -> None:
    assert 0.925 <= coverage(4, 15, draw) <= 0.97


def test_of_small_cells_in_which_plain_percentiles_would_cover_88_percent() -> None:
    assert 0.925 <= coverage(20, 3, normal) <= 0.97


def test_the_check_notices_an_interval_that_is_too_narrow_or_too_wide() -> None:
    assert coverage(20, 15, normal, confidence=0.9, sets=400) < 0.93
    assert coverage(20, 15, normal, stratified=False, sets=400) > 0.97
