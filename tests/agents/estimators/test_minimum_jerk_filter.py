"""The filter is consistent on its own model, and tracks strokes that it was not told of."""

import math
from dataclasses import replace

import numpy as np
import pytest
from colift.agents.estimators.minimum_jerk import MinimumJerkStroke
from colift.agents.estimators.minimum_jerk_filter import (
    MinimumJerkFilter,
    MinimumJerkFilterParameters,
)
from colift.agents.estimators.minimum_jerk_process import MinimumJerkProcess
from colift.base.errors import InputError
from scipy.stats import chi2

TRUTH = MinimumJerkFilterParameters()
RUNS, TIMES = 300, (1, 3, 6, 10, 15, 20, 30)
BOUNDS = np.array(chi2.interval(0.95, 5 * RUNS)) / RUNS


def simulate(seed=1):
    """Return states (runs, steps, 5) drawn from the model, 0.1 s apart, and measured heights."""
    rng = np.random.default_rng(seed)
    start = MinimumJerkFilter(TRUTH)
    start.reset(0.1)
    deviations, noise = np.sqrt(np.diag(start.covariance)), TRUTH.process.noise(0.1)
    states = np.empty((RUNS, TIMES[-1], 5))
    for run in states:
        state = start.state + deviations * rng.standard_normal(5)
        for step, disturbance in enumerate(
            rng.multivariate_normal(np.zeros(5), noise, TIMES[-1], method="eigh")
        ):
            run[step] = state = TRUTH.process.advance(state, 0.1)[0] + disturbance
    measured = states[:, :, 0] + TRUTH.measurement_noise * rng.standard_normal(states.shape[:2])
    return states, measured


@pytest.fixture(scope="module")
def world():
    return simulate()


def nees(world, parameters=TRUTH):
    """Yield the mean normalised estimation error squared at each of the times."""
    trackers = [MinimumJerkFilter(parameters) for _ in range(RUNS)]
    for tracker in trackers:
        tracker.reset(0.1)
    states, measured = world
    for step in range(TIMES[-1]):
        for tracker, height in zip(trackers, measured[:, step], strict=True):
            tracker.predict(0.1)
            tracker.update(height)
        if step + 1 in TIMES:
            errors = states[:, step] - [tracker.state for tracker in trackers]
            covariances = [tracker.covariance for tracker in trackers]
            solved = np.linalg.solve(covariances, errors[..., np.newaxis])[..., 0]
            yield (errors * solved).sum() / RUNS


def test_errors_on_its_own_model_are_what_the_covariance_says(world):
    """The mean NEES of 5 states is within the 95 % interval of chi-square, at several times."""
    found = list(nees(world))
    assert len(found) == len(TIMES)
    assert all(BOUNDS[0] < each < BOUNDS[1] for each in found)


@pytest.mark.parametrize("factor", [0.75, 1.4])
@pytest.mark.parametrize(
    "name", ["jerk_noise", "measurement_noise", "duration_deviation", "displacement"]
)
def test_a_wrong_noise_shows(world, name, factor):
    if name == "jerk_noise":
        process = replace(TRUTH.process, jerk_noise=factor * TRUTH.process.jerk_noise)
        found = nees(world, replace(TRUTH, process=process))
    else:
        found = nees(world, replace(TRUTH, **{name: factor * getattr(TRUTH, name)}))
    assert any(each > BOUNDS[1] if factor < 1 else each < BOUNDS[0] for each in found)


@pytest.mark.parametrize(
    ("columns", "factor"),
    [(slice(0, 3), 0.9), (slice(0, 3), 1.1), (slice(3, 4), 0.8), (slice(3, 4), 1.25)],
)
def test_a_wrong_jacobian_shows(world, monkeypatch, columns, factor):
    """A clock's column that is too small only makes the filter learn less, and stay consistent.

    That shows by the finite differences of the process.
    """
    advance = MinimumJerkProcess.advance

    def wrong(self, state, period):
        moved, jacobian = advance(self, state, period)
        jacobian[:4, columns] *= factor
        return moved, jacobian

    monkeypatch.setattr(MinimumJerkProcess, "advance", wrong)
    assert any(not BOUNDS[0] < each < BOUNDS[1] for each in nees(world))


@pytest.mark.parametrize("rise", [-0.15, 0.2])
@pytest.mark.parametrize("period", [0.02, 0.1])
def test_a_stroke_of_the_mean_duration_is_foreseen(rise, period):
    """From the middle on, the coming 0.2 s to 3 % of the rise, and the goal to 15 %."""
    stroke = MinimumJerkStroke(start=0.05, end=0.05 + rise, onset=0.0, duration=2.0)
    tracker = MinimumJerkFilter(TRUTH)
    tracker.reset(0.05)
    for k in range(1, round(2.0 / period) + 1):
        tracker.predict(period)
        tracker.update(float(stroke.height(period * k)))
        ahead = tracker.ahead(0.2)[0] - stroke.height(period * k + 0.2)
        assert abs(ahead) < 0.05 * abs(rise)
        if period * k > 1.0:
            assert abs(ahead) < 0.03 * abs(rise)
            assert abs(TRUTH.process.goal(tracker.state) - stroke.end) < 0.15 * abs(rise)


def test_at_rest_it_expects_rest_and_a_movement_up_or_down():
    tracker = MinimumJerkFilter()
    tracker.reset(0.12)
    assert tracker.ahead(0.3)[:4] == pytest.approx([0.12, 0.0, 0.0, 0.0])
    assert TRUTH.process.goal(tracker.state) == pytest.approx(0.12)
    left, _ = TRUTH.process.time_to_go(TRUTH.duration)
    way = math.sqrt(tracker.covariance[3, 3]) * left**3 / 60
    assert way == pytest.approx(TRUTH.displacement)


def test_looking_ahead_changes_nothing():
    tracker = MinimumJerkFilter()
    tracker.reset(0.0)
    for height in (0.001, 0.004, 0.011):
        tracker.predict(0.1)
        tracker.update(height)
    before, covariance = tracker.state, tracker.covariance
    ahead = tracker.ahead(0.2)
    assert (tracker.state == before).all()
    assert (tracker.covariance == covariance).all()
    tracker.predict(0.2)
    assert (tracker.state == ahead).all()


@pytest.mark.parametrize("value", [math.nan, math.inf])
def test_what_is_not_a_number_is_refused(value):
    tracker = MinimumJerkFilter()
    with pytest.raises(ValueError, match="height must be finite"):
        tracker.reset(value)
    tracker.reset(0.1)
    with pytest.raises(ValueError, match="height must be finite"):
        tracker.update(value)
    for period in (value, 0.0, -0.1):
        with pytest.raises(ValueError, match="period must be a positive number"):
            tracker.predict(period)
        with pytest.raises(ValueError, match="period must be a positive number"):
            tracker.ahead(period)
    assert tracker.state[0] == 0.1


@pytest.mark.parametrize(
    "name", ["measurement_noise", "duration", "duration_deviation", "displacement"]
)
@pytest.mark.parametrize("value", [0.0, -1.0, math.inf, math.nan])
def test_impossible_parameters_are_refused(name, value):
    with pytest.raises(InputError, match=f"{name} must be a positive number, got {value}"):
        MinimumJerkFilterParameters(**{name: value})
