import numpy as np
import pytest
from colift.base.errors import InputError
from colift.benchmark.statistics import holm_correction


def many() -> list[np.ndarray]:
    rng = np.random.default_rng(0)
    return [rng.uniform(0.0, 1.0, size) ** 3 for size in range(1, 40)]


def test_of_the_textbook_example() -> None:
    """Four p values at 5 %: the two smallest are rejected (0.005 * 4, 0.01 * 3), no others."""
    corrected = holm_correction([0.01, 0.04, 0.03, 0.005])
    assert corrected == pytest.approx([0.03, 0.06, 0.06, 0.02])


@pytest.mark.parametrize("ps", many())
def test_never_below_the_raw_value_nor_above_one_nor_above_bonferroni(ps: np.ndarray) -> None:
    corrected = holm_correction(ps)
    assert (corrected >= ps).all()
    assert (corrected <= np.minimum(1.0, len(ps) * ps)).all()


@pytest.mark.parametrize("ps", many())
def test_keeps_the_order_and_does_not_depend_on_it(ps: np.ndarray) -> None:
    corrected = holm_correction(ps)
    order = ps.argsort()
    assert (np.diff(corrected[order]) >= 0.0).all()
    shuffled = np.random.default_rng(1).permutation(len(ps))
    assert (holm_correction(ps[shuffled]) == corrected[shuffled]).all()


def test_equal_values_stay_equal() -> None:
    assert holm_correction([0.02, 0.02, 0.5]).tolist() == [0.06, 0.06, 0.5]


def test_of_one_value_or_none_changes_nothing() -> None:
    assert holm_correction([0.03]).tolist() == [0.03]
    assert holm_correction([]).tolist() == []


def test_of_independent_tests_goes_wrong_in_at_most_five_percent() -> None:
    rng = np.random.default_rng(2)
    wrong = [holm_correction(rng.uniform(size=10)).min() <= 0.05 for _ in range(4000)]
    raw = [rng.uniform(size=10).min() <= 0.05 for _ in range(4000)]
    assert np.mean(wrong) == pytest.approx(0.05, abs=0.01)
    assert np.mean(raw) > 0.35


@pytest.mark.parametrize("bad", [[0.1, np.nan], [-0.1], [1.1], [[0.1]]])
def test_refuses_what_is_no_p_value(bad: list[float]) -> None:
    with pytest.raises(InputError, match="from 0 to 1"):
        holm_correction(bad)
