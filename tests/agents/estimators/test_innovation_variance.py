"""The deviation is the root of the memory mean square of the misses."""

import math

import numpy as np
import pytest
from colift.agents.estimators.innovation_variance import (
    InnovationVariance,
    InnovationVarianceParameters,
)
from colift.base.errors import InputError


def watch(heights, forecast, period=0.1, **values):
    deviation = InnovationVariance(InnovationVarianceParameters(**values))
    told = []
    for k, height in enumerate(heights):
        deviation.compare(period * k, height, period)
        told.append(deviation.deviation)
        deviation.remember(period * k, forecast(k))
    return np.array(told)


def test_good_forecasts_leave_the_floor():
    told = watch(0.01 * np.arange(30), lambda k: lambda time: 0.1 * time, floor=0.0005)
    assert told == pytest.approx(np.full(30, 0.0005))


def test_constant_misses_count_with_their_share():
    told = watch(np.full(30, 0.01), lambda k: lambda time: 0.0, floor=0.0005, fraction=0.5)
    assert told[0] == 0.0005
    assert told[1:] == pytest.approx(np.full(29, math.hypot(0.0005, 0.005)))


def test_misses_are_forgotten_exponentially():
    rng = np.random.default_rng(4)
    heights = rng.normal(0.0, 0.01, 40)
    told = watch(heights, lambda k: lambda time: 0.0, fraction=1.0, memory=0.3)[-1]
    weights = np.exp(-0.1 * np.arange(39)[::-1] / 0.3)
    expected = math.sqrt(0.0007**2 + np.average(heights[1:] ** 2, weights=weights))
    assert told == pytest.approx(expected)


@pytest.mark.parametrize(("period", "steps"), [(0.02, 5), (0.05, 2), (0.1, 1), (0.2, 1)])
def test_a_sample_is_compared_with_the_newest_forecast_as_old_as_the_horizon(period, steps):
    """The forecast made at step k says k; the sample at step n says n - steps."""
    values = np.maximum(np.arange(40) - steps, 0).astype(float)
    told = watch(values, lambda k: lambda time: float(k), period, fraction=1.0)
    assert told == pytest.approx(np.full(40, 0.0007))
    told = watch(values + 1.0, lambda k: lambda time: float(k), period, fraction=1.0)
    assert told[steps:] == pytest.approx(np.full(40 - steps, math.hypot(0.0007, 1.0)))


@pytest.mark.parametrize(
    ("values", "message"),
    [
        ({"floor": 0.0}, "floor must be a positive number, got 0.0"),
        ({"fraction": -0.1}, "fraction must be a number of at least 0, got -0.1"),
        ({"memory": math.inf}, "memory must be a positive number, got inf"),
        ({"horizon": math.nan}, "horizon must be a positive number, got nan"),
    ],
)
def test_impossible_parameters_are_refused(values, message):
    with pytest.raises(InputError, match=message):
        InnovationVarianceParameters(**values)
