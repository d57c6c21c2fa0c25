"""Student's t against published quantiles (Abramowitz & Stegun, table 26.10)."""

import pytest
from colift.benchmark.statistics.student import t_cdf, t_quantile


@pytest.mark.parametrize(
    ("freedom", "quantile"),
    [(1, 12.706), (2, 4.303), (3, 3.182), (4, 2.776), (10, 2.228), (30, 2.042), (120, 1.980)],
)
def test_the_quantiles_are_those_of_the_table(freedom: int, quantile: float) -> None:
    assert t_quantile(0.975, freedom) == pytest.approx(quantile, abs=0.0006)
    assert t_quantile(0.025, freedom) == pytest.approx(-quantile, abs=0.0006)


@pytest.mark.parametrize("freedom", [1, 2, 7, 74])
def test_the_quantile_is_the_inverse_of_the_probability(freedom: int) -> None:
    for p in (0.001, 0.3, 0.5, 0.9, 0.999):
        assert t_cdf(t_quantile(p, freedom), freedom) == pytest.approx(p, abs=1e-9)


@pytest.mark.parametrize("freedom", range(1, 80))
def test_no_probability_is_beyond_0_or_1(freedom):
    for t in (4.0**i for i in range(-4, 30)):
        assert 0.0 <= t_cdf(-t, freedom) <= t_cdf(t, freedom) <= 1.0
