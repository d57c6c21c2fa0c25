"""A synthetic pair has the measures that were put in, at any rate and with noise."""

import math

import numpy as np
import pytest
from colift.benchmark.pairs.coordination import Ends, coordination, measure_of
from hypothesis import given, settings
from hypothesis import strategies as st

from .synthetic import START, height, pair

RATES = (15.0, 30.0, 100.0, 119.88, 240.0, 1000.0)


def measured(times, near, far, **more):
    return coordination(Ends(times=times, near=near, far=far, **more))


@settings(deadline=None, max_examples=60)
@given(
    rate=st.sampled_from(RATES),
    lag=st.floats(-0.4, 0.6),
    gain=st.floats(0.7, 1.3),
    difference=st.floats(-0.08, 0.08),
)
def test_without_noise_what_was_put_in_comes_out(rate, lag, gain, difference):
    found = measured(*pair(rate, lag=lag, gain=gain, difference=difference))
    assert found.lag_ms == pytest.approx(1000 * lag, abs=0.1)
    assert found.abs_lag_ms == abs(found.lag_ms)
    assert found.gain == pytest.approx(gain, abs=1e-4)
    assert found.start_difference_mm == pytest.approx(1000 * difference, abs=0.05)


@settings(deadline=None, max_examples=60)
@given(
    rate=st.sampled_from(RATES),
    lag=st.floats(-0.4, 0.6),
    gain=st.floats(0.7, 1.3),
    difference=st.floats(-0.08, 0.08),
    seed=st.integers(0, 10_000),
)
def test_with_a_millimetre_of_noise_it_comes_out_nearly(rate, lag, gain, difference, seed):
    made = pair(rate, lag=lag, gain=gain, difference=difference, noise=0.001, seed=seed)
    found = measured(*made)
    # Five standard errors of the least squares, which fall with the root of the number of samples.
    few = math.sqrt(100.0 / min(rate, 100.0))
    assert found.lag_ms == pytest.approx(1000 * lag, abs=4.0 * few)
    assert found.gain == pytest.approx(gain, abs=0.004 * few)
    assert found.start_difference_mm == pytest.approx(1000 * difference, abs=2.0 * few)


@pytest.mark.parametrize("rate", RATES)
def test_lags_between_samples_are_not_drawn_to_samples(rate):
    lags = np.arange(0.100, 0.120, 0.00125)
    errors = [
        measured(*pair(rate, lag=lag, noise=0.001, seed=i)).lag_ms - 1000 * lag
        for i, lag in enumerate(lags)
    ]
    assert abs(np.mean(errors)) < 1.0


def test_an_inclined_table_is_in_the_rmse_and_not_about_the_mean():
    level = measured(*pair(100.0, lag=0.05))
    tilted = measured(*pair(100.0, lag=0.05, difference=0.03), length=1.2)
    assert tilted.rmse_about_mean_mm == pytest.approx(level.rmse_about_mean_mm)
    assert tilted.mean_difference_mm == pytest.approx(level.mean_difference_mm + 30.0)
    squares = tilted.rmse_about_mean_mm**2 + tilted.mean_difference_mm**2
    assert tilted.rmse_mm**2 == pytest.approx(squares)
    sine = tilted.mean_difference_mm / 1200
    assert tilted.mean_tilt_deg == pytest.approx(math.degrees(math.asin(sine)))
    assert math.isnan(level.mean_tilt_deg)


def test_a_measured_inclination_needs_no_length():
    times, near, far = pair(100.0)
    found = measured(times, near, far, tilts=2.0 + np.sin(times))
    assert found.mean_tilt_deg == pytest.approx(np.mean(2.0 + np.sin(times)))


def test_the_rmse_is_that_of_the_samples():
    times, near, far = pair(100.0, lag=0.06, difference=0.01, noise=0.002)
    found = measured(times, near, far)
    assert found.rmse_mm == pytest.approx(1000 * np.sqrt(np.mean((near - far) ** 2)))


def test_irregular_samples_have_the_measures_of_regular_ones():
    rng = np.random.default_rng(2)
    times = np.sort(rng.choice(np.arange(0.0, 7.0, 0.01), 450, replace=False))
    found = measured(times, height(times), START + 1.1 * (height(times - 0.07) - START))
    whole = measured(*pair(100.0, lag=0.07, gain=1.1))
    assert found.lag_ms == pytest.approx(70.0, abs=0.5)
    assert found.gain == pytest.approx(1.1, abs=0.001)
    assert found.rmse_mm == pytest.approx(whole.rmse_mm, rel=0.02)


def test_an_end_that_does_not_follow_has_neither_lag_nor_gain():
    times, near, _ = pair(100.0)
    still = measured(times, near, np.full(len(times), START))
    away = measured(times, near, 2 * START - near)
    late = measured(*pair(100.0, lag=3.0))
    for found in (still, away, late):
        assert math.isnan(found.lag_ms)
        assert math.isnan(found.gain)
        assert found.rmse_mm > 0.0
    assert still.plain()["lag_ms"] is None


def test_each_part_of_a_lift_that_has_a_name_has_its_rmse():
    times, near, far = pair(100.0, difference=0.01)
    far = np.where(times < 2.0, far, far - 0.02)
    phases = tuple(np.where(times < 2.0, "rise", np.where(times < 5.0, "hold", "")).tolist())
    found = measured(times, near, far, phases=phases)
    assert found.rmse_mm_by_phase == pytest.approx({"rise": 10.0, "hold": 30.0}, abs=0.5)
    assert measure_of([*found.values()][-1]).label == "RMSE in hold"


def test_the_force_is_measured_about_its_mean():
    times, near, far = pair(100.0)
    found = measured(times, near, far, force=7.0 + np.sin(2 * np.pi * times))
    assert found.force_n == pytest.approx(math.sqrt(0.5), rel=0.01)
