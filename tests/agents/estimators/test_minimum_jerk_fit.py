"""Strokes are recovered from their beginning; forecasts are the Bayesian mean."""

import math

import numpy as np
import pytest
from colift.agents.estimators.minimum_jerk import MinimumJerkStroke, profile
from colift.agents.estimators.minimum_jerk_fit import MinimumJerkFit, MinimumJerkFitParameters
from colift.base.errors import InputError

NOISE_FREE = 1e-5


def stroke(rise=0.2, duration=2.0, onset=0.55, start=0.04):
    return MinimumJerkStroke(start=start, end=start + rise, onset=onset, duration=duration)


def prefix(of, share, period=0.1, rest=0.3):
    """Return the sample times from before the onset until a share of the stroke is behind."""
    times = period * np.arange(1 + math.floor((of.onset + share * of.duration) / period + 1e-9))
    return times[times >= of.onset - rest]


@pytest.mark.parametrize("period", [0.02, 0.1])
@pytest.mark.parametrize("onset", [0.5, 0.513, 0.55, 0.587])
@pytest.mark.parametrize("duration", [0.8, 1.4, 2.0, 3.1, 4.0])
@pytest.mark.parametrize("rise", [0.05, 0.2, 0.35, -0.1, -0.3])
def test_the_end_of_a_noise_free_stroke_is_known_from_its_first_40_percent(
    rise, duration, onset, period
):
    true = stroke(rise, duration, onset)
    times = prefix(true, 0.4, period)
    found = MinimumJerkFit(times, true.height(times), NOISE_FREE).stroke
    assert found.end == pytest.approx(true.end, abs=0.05 * abs(rise))
    assert found.start == pytest.approx(true.start, abs=0.01 * abs(rise))
    assert found.onset == pytest.approx(true.onset, abs=0.05)
    assert found.duration == pytest.approx(true.duration, rel=0.05)


def test_with_noise_the_end_gets_better_as_the_stroke_goes_on():
    rng = np.random.default_rng(2)
    true = stroke()
    errors = []
    for share in (0.3, 0.6, 0.95):
        times = prefix(true, share)
        missed = []
        for _ in range(40):
            heights = true.height(times) + rng.normal(0.0, 2.3e-4, len(times))
            missed.append(MinimumJerkFit(times, heights, 7e-4).stroke.end - true.end)
        errors.append(np.sqrt(np.mean(np.square(missed))))
    assert errors[0] > 2 * errors[1] > 4 * errors[2]
    assert errors[2] < 0.01


def test_the_best_stroke_has_no_better_neighbour():
    """Its onset and duration minimise the weighted squares plus the prior of the rise."""
    rng = np.random.default_rng(3)
    true, deviation, given = stroke(), 5e-4, MinimumJerkFitParameters()
    times = prefix(true, 0.7)
    heights = true.height(times) + rng.normal(0.0, deviation, len(times))
    weights = np.exp((times - times[-1]) / given.memory)

    def cost(start, end, onset, duration):
        at = MinimumJerkStroke(start=start, end=end, onset=onset, duration=duration)
        missed = weights @ np.square(heights - at.height(times)) / deviation**2
        return missed + ((end - start) / given.rise) ** 2

    found = MinimumJerkFit(times, heights, deviation).stroke
    best = np.array([found.start, found.end, found.onset, found.duration])
    step = 1e-2 * np.array([0.01, 0.02, 0.1, 0.3])
    others = [cost(*(best + sign * side)) for side in np.diag(step) for sign in (-1, 1)]
    assert min(others) > cost(*best)


def brute_force(times, heights, deviation, given, at):
    """Return the mean forecast by numerical integration over start, rise and the grid."""
    spacing = times[1] - times[0]
    weights = np.exp((times - times[-1]) / given.memory) * spacing / 0.1
    inverse = np.diag(deviation**2 / weights)
    total = mean = 0.0
    for duration in np.geomspace(*given.durations, given.grid[0]):
        for gone in np.linspace(*given.elapsed, given.grid[1]):
            done = profile(gone + (times - times[-1]) / duration)
            wide = 10.0
            covariance = inverse + wide**2 + given.rise**2 * np.outer(done, done)
            solved = np.linalg.solve(covariance, heights)
            likelihood = np.exp(-0.5 * heights @ solved) / np.sqrt(np.linalg.det(covariance / 1e-6))
            there = profile(gone + (at - times[-1]) / duration)
            expected = (wide**2 + given.rise**2 * there * done) @ solved
            total += likelihood
            mean += likelihood * expected
    return mean / total


@pytest.mark.parametrize(("period", "seed"), [(0.1, 0), (0.1, 1), (0.05, 2)])
def test_the_forecast_is_that_of_gaussian_processes_weighed_by_their_likelihood(period, seed):
    """Given onset and duration, a stroke is a Gaussian process: textbook formulas apply."""
    given = MinimumJerkFitParameters(grid=(6, 9))
    true = stroke()
    times = prefix(true, 0.5, period)[-10:]
    heights = true.height(times) + np.random.default_rng(seed).normal(0.0, 2e-3, len(times))
    fit = MinimumJerkFit(times, heights, 3e-3, given)
    for at in (times[-1], times[-1] + 0.22, times[-1] + 1.0, 100.0):
        expected = brute_force(times, heights, 3e-3, given, at)
        assert fit.height(at) == pytest.approx(expected, abs=2e-5)


def test_less_trusted_samples_move_the_forecast_less():
    true = stroke()
    times = prefix(true, 0.5)
    rises = [
        MinimumJerkFit(times, true.height(times), deviation).height(times[-1] + 1.0) - 0.04
        for deviation in (1e-4, 1e-2, 1e-1)
    ]
    assert rises[0] > 1.2 * rises[1] > 1.2 * rises[2] > 0


def test_where_it_is_does_not_matter():
    true = stroke()
    times = prefix(true, 0.6)
    here = MinimumJerkFit(times, true.height(times), 7e-4)
    there = MinimumJerkFit(times + 50.0, -true.height(times), 7e-4)
    assert there.height(times[-1] + 50.22) == pytest.approx(-here.height(times[-1] + 0.22))
    assert there.stroke.end == pytest.approx(-here.stroke.end, abs=1e-5)


def test_the_duration_stays_within_the_limits():
    times = 0.1 * np.arange(12)
    for heights in (0.3 * times, 0.3 * times**3, np.where(times > 1.05, 0.05, 0.0), 0 * times):
        found = MinimumJerkFit(times, heights, 7e-4).stroke
        assert 0.6 <= found.duration <= 4.5
        assert np.isfinite([found.start, found.end, found.onset]).all()


def test_a_stroke_that_has_just_begun_is_not_thought_to_go_on_for_metres():
    times = 0.1 * np.arange(6)
    for first in (0.002, 0.01, 0.04):
        heights = np.where(times > 0.45, first, 0.0)
        found = MinimumJerkFit(times, heights, 7e-4).stroke
        assert first < found.end < 3 * MinimumJerkFitParameters().rise


def test_too_few_samples_are_refused():
    with pytest.raises(ValueError, match="needs 3 samples or more, got 2 times and 2 heights"):
        MinimumJerkFit(np.arange(2.0), np.zeros(2), 7e-4)
    with pytest.raises(ValueError, match="got 4 times and 3 heights"):
        MinimumJerkFit(np.arange(4.0), np.zeros(3), 7e-4)


@pytest.mark.parametrize(
    ("values", "message"),
    [
        ({"durations": (2.0, 1.0)}, r"durations must be two increasing positive numbers"),
        ({"elapsed": (0.0, 1.0)}, r"elapsed must be two increasing positive numbers"),
        ({"rise": 0.0}, "rise must be a positive number, got 0.0"),
        ({"memory": math.nan}, "memory must be a positive number, got nan"),
        ({"grid": (1, 30)}, r"grid must be at least 2 x 2, got \(1, 30\)"),
    ],
)
def test_impossible_parameters_are_refused(values, message):
    with pytest.raises(InputError, match=message):
        MinimumJerkFitParameters(**values)
