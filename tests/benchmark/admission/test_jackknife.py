"""Intervals by leaving out one at a time."""

import numpy as np
import pytest
from colift.base.errors import InputError
from colift.benchmark.admission.jackknife import ratio_interval, spread


def test_the_interval_of_a_mean_is_students():
    values = np.array([1.0, 2.0, 4.0, 8.0])
    left = [np.delete(values, i).mean() for i in range(4)]
    low, high = spread(left).around(values.mean())
    reach = 3.182446 * values.std(ddof=1) / 2
    assert (low, high) == pytest.approx((values.mean() - reach, values.mean() + reach))


def test_two_samples_add_their_variances():
    one, other = spread([1.0, 2.0, 3.0]), spread([5.0, 5.5])
    both = spread([1.0, 2.0, 3.0], [5.0, 5.5])
    assert both.error == pytest.approx(np.hypot(one.error, other.error))
    assert 1.0 <= both.dof <= 3.0


def test_the_interval_of_a_ratio_is_symmetric_in_its_logarithm():
    low, high = ratio_interval(2.0, [1.9, 2.0, 2.2])
    assert low * high == pytest.approx(4.0)


def test_one_member_has_no_interval():
    with pytest.raises(InputError, match="2 members of a sample or more, got 1"):
        spread([1.0])
