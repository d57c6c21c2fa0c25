import math

import numpy as np
import pytest
from colift.agents.estimators.motion_filter import MotionFilter, MotionFilterParameters
from colift.agents.estimators.residuals import LONGEST, ResidualConfidence, chi_square_tail
from colift.base.errors import InputError


@pytest.mark.parametrize(
    ("value", "degrees"),
    # 95 % and 99 % points of the chi-square distribution, from any statistics table.
    [(3.8415, 1), (5.9915, 2), (7.8147, 3), (11.0705, 5), (18.3070, 10), (124.3421, 100)],
)
def test_tail_is_5_percent_at_the_tabulated_points(value, degrees):
    assert chi_square_tail(value, degrees) == pytest.approx(0.05, rel=2e-4)


@pytest.mark.parametrize(("value", "degrees"), [(6.6349, 1), (9.2103, 2), (15.0863, 5)])
def test_tail_is_1_percent_at_the_tabulated_points(value, degrees):
    assert chi_square_tail(value, degrees) == pytest.approx(0.01, rel=2e-4)


@pytest.mark.parametrize("degrees", [1, 2, 3, 8, 25, LONGEST])
def test_minus_the_tails_slope_is_the_density(degrees):
    for value in (0.5, degrees / 2, 2.0 * degrees):
        width = 1e-4 * value
        low, high = (chi_square_tail(value + side * width, degrees) for side in (-1, 1))
        log_density = (
            (degrees / 2 - 1) * math.log(value)
            - value / 2
            - degrees / 2 * math.log(2)
            - math.lgamma(degrees / 2)
        )
        assert (low - high) / (2 * width) == pytest.approx(
            math.exp(log_density), rel=1e-5, abs=1e-11
        )


@pytest.mark.parametrize("degrees", [1, 2, 7, LONGEST])
def test_tail_goes_from_one_to_nothing(degrees):
    assert chi_square_tail(0.0, degrees) == 1.0
    values = [chi_square_tail(value, degrees) for value in np.linspace(0.0, 400.0, 200)]
    assert min(values) >= 0.0
    assert max(values) <= 1.0
    # Falling, up to the rounding of sums near 1.
    assert np.diff(values).max() < 1e-14
    assert chi_square_tail(1e12, degrees) == 0.0


def test_by_hand():
    confidence = ResidualConfidence(window=2)
    assert confidence.update(2.0, 4.0) == pytest.approx(math.erfc(math.sqrt(1 / 2)))
    assert confidence.update(-3.0, 3.0) == pytest.approx(math.exp(-(1 + 3) / 2))
    # The first has left the window.
    assert confidence.update(1.0, 1.0) == pytest.approx(math.exp(-(3 + 1) / 2))


@pytest.mark.parametrize("window", [1, 5, 20])
def test_confidence_in_a_true_model_is_even(window):
    rng = np.random.default_rng(8)
    values = []
    for _ in range(2000):
        confidence = ResidualConfidence(window)
        deviations = rng.uniform(0.1, 9.0, window)
        told = [confidence.update(s * rng.standard_normal(), s**2) for s in deviations]
        values.append(told[-1])
    # The 0.1 % point of the Kolmogorov-Smirnov distance is 1.95 / sqrt(n).
    distance = np.abs(np.sort(values) - np.arange(1, 2001) / 2000).max()
    assert distance < 1.95 / math.sqrt(2000)


def test_confidence_in_a_filter_whose_model_is_true_is_even():
    parameters = MotionFilterParameters(process_noise=1e6, initial_deviation=(1e-3, 1e-3, 1e-3))
    rng = np.random.default_rng(3)
    period, noise = 0.1, math.sqrt(parameters.measurement_noise)
    transition = np.array([[1, period, period**2 / 2], [0, 1, period], [0, 0, 1]])
    gain = np.array([period**3 / 6, period**2 / 2, period])
    values = []
    for _ in range(60):
        state, confidence = np.zeros(3), ResidualConfidence(5)
        tracker = MotionFilter(parameters)
        tracker.reset(0.0)
        for k in range(20):
            state = transition @ state + gain * rng.normal(0.0, 1e3)
            measured = (state[0] + noise * rng.standard_normal()) / 1000
            expected = tracker.predict(period)
            innovation = 1000 * (measured - expected.height)
            told = confidence.update(innovation, expected.variance + noise**2)
            tracker.update(measured)
            # Windows that do not overlap are independent.
            if k % 5 == 4:
                values.append(told)
    distance = np.abs(np.sort(values) - np.arange(1, 241) / 240).max()
    assert distance < 1.95 / math.sqrt(240)


def test_errors_that_are_too_large_shake_it_more_surely_in_a_long_window():
    rng = np.random.default_rng(5)
    innovations = 1.6 * rng.standard_normal((400, 20))
    told = {}
    for window in (2, 20):
        values = []
        for row in innovations:
            confidence = ResidualConfidence(window)
            values.append([confidence.update(error, 1.0) for error in row][-1])
        told[window] = np.mean(values)
    assert told[20] < 0.12 < 0.2 < told[2] < 0.4


def test_an_outlier_is_forgotten_when_it_leaves_the_window():
    confidence = ResidualConfidence(4)
    confidence.update(30.0, 1.0)
    told = [confidence.update(0.0, 1.0) for _ in range(4)]
    assert max(told[:3]) < 1e-9
    assert told[3] == 1.0


@pytest.mark.parametrize("window", [0, -1, LONGEST + 1])
def test_an_impossible_window_is_refused(window):
    with pytest.raises(InputError, match=f"window must be from 1 to 100 residuals, got {window}"):
        ResidualConfidence(window)
