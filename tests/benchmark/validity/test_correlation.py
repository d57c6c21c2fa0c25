import numpy as np
import pytest
from colift.benchmark.validity.correlation import average_ranks, kendall, spearman

stats = pytest.importorskip("scipy.stats", reason="needs SciPy: uv sync --all-extras")


def test_ties_share_the_mean_of_their_ranks():
    values = np.array([[3.0, 1.0, 2.0, 1.0], [5.0, 5.0, 5.0, 5.0]])
    assert average_ranks(values).tolist() == [[4.0, 1.5, 3.0, 1.5], [2.5, 2.5, 2.5, 2.5]]


@pytest.mark.parametrize("levels", [3, 1000])
def test_the_correlations_are_those_of_scipy_with_and_without_ties(levels):
    rng = np.random.default_rng(levels)
    a, b = rng.integers(0, levels, (2, 50, 9)).astype(float)
    for mine, theirs in ((spearman, stats.spearmanr), (kendall, stats.kendalltau)):
        wanted = [theirs(*pair).statistic for pair in zip(a, b, strict=True)]
        assert mine(a, b) == pytest.approx(wanted, abs=1e-12)


def test_same_and_reverse_order():
    a = np.array([1.0, 2.0, 4.0, 8.0])
    for correlation in (spearman, kendall):
        assert correlation(a, a**3) == pytest.approx(1.0)
        assert correlation(a, -a) == pytest.approx(-1.0)


def test_without_an_order_nothing_is_predicted():
    a, level = np.array([1.0, 2.0, 3.0, 4.0]), np.full(4, 7.0)
    assert (spearman(a, level), kendall(a, level)) == (0.0, 0.0)
