"""The motion filter against textbooks: each fact computed a second way."""

import dataclasses
import math

import numpy as np
import pytest
from colift.agents.estimators.motion_filter import (
    MotionFilter,
    MotionFilterParameters,
    process_covariance,
    transition,
)
from colift.base.errors import InputError
from scipy.linalg import expm, solve_discrete_are
from scipy.stats import chi2

FORMS = ["jerk", "acceleration"]
DYNAMICS = np.diag([1.0, 1.0], k=1)
"""Continuous dynamics of (s, v, a): each entry is the rate of the one before."""


def parameters(form="jerk", **changes):
    return MotionFilterParameters(
        measurement_noise=0.9,
        process_noise=2e4,
        noise_enters=form,
        initial_deviation=(1.0, 20.0, 150.0),
        **changes,
    )


class Textbook:
    """A Kalman filter as printed in any book, in mm and s."""

    def __init__(self, mean, covariance, noise):
        self.x, self.p, self.r = mean, covariance, noise

    def predict(self, f, q):
        self.x, self.p = f @ self.x, f @ self.p @ f.T + q

    def update(self, z):
        h = np.array([1.0, 0.0, 0.0])
        gain = self.p @ h / (h @ self.p @ h + self.r)
        self.x = self.x + gain * (z - h @ self.x)
        self.p = (np.eye(3) - np.outer(gain, h)) @ self.p


@pytest.mark.parametrize("period", [0.01, 0.1, 0.37])
def test_transition_is_the_exponential_of_constant_acceleration(period):
    assert transition(period) == pytest.approx(expm(DYNAMICS * period), abs=1e-15)


def test_transition_by_finite_differences_of_equation_4():
    def equation_4(x, t=0.1):
        s, v, a = x
        return np.array([s + v * t + a * t**2 / 2, v + a * t, a])

    at, width = np.array([100.0, -50.0, 30.0]), 1e-3
    columns = [(equation_4(at + d) - equation_4(at - d)) / (2 * width) for d in width * np.eye(3)]
    assert transition(0.1) == pytest.approx(np.transpose(columns), abs=1e-9)
    assert transition(0.1) @ at == pytest.approx(equation_4(at), rel=1e-14)


def test_two_short_steps_are_a_long_one():
    assert transition(0.03) @ transition(0.07) == pytest.approx(transition(0.1), abs=1e-15)


def test_process_covariance_of_jerk_is_what_a_constant_jerk_does_in_a_step():
    """By quadrature with three nodes, which is exact: the integrand is quadratic in time."""
    period = 0.1
    nodes, weights = np.polynomial.legendre.leggauss(3)
    effects = [expm(DYNAMICS * period * (1 - node) / 2)[:, 2] for node in nodes]
    effect = weights @ effects * period / 2
    expected = 2e4 * np.outer(effect, effect)
    assert process_covariance(parameters("jerk"), period) == pytest.approx(expected, rel=1e-12)


def test_process_covariance_of_acceleration_enters_the_acceleration_alone():
    covariance = process_covariance(parameters("acceleration"), 0.1)
    assert covariance[2, 2] == pytest.approx(200.0)
    covariance[2, 2] = 0.0
    assert not covariance.any()


def test_both_forms_disturb_the_acceleration_equally():
    jerk, acceleration = (process_covariance(parameters(form), 0.1)[2, 2] for form in FORMS)
    assert jerk == pytest.approx(acceleration, rel=1e-12)


@pytest.mark.parametrize("form", FORMS)
@pytest.mark.parametrize("regular", [True, False])
def test_state_and_variance_are_those_of_a_textbook_filter(form, regular):
    rng = np.random.default_rng(1)
    given = parameters(form)
    ours = MotionFilter(given)
    ours.reset(0.05)
    book = Textbook(np.array([50.0, 0.0, 0.0]), np.diag([1.0, 400.0, 22500.0]), 0.9)
    # With other periods in between, every entry of the covariance shows in what follows.
    for period in np.full(200, 0.1) if regular else rng.uniform(0.02, 0.3, 200):
        prediction = ours.predict(period)
        book.predict(transition(period), process_covariance(given, period))
        assert prediction.variance == pytest.approx(book.p[0, 0], rel=1e-9)
        told = (prediction.height, prediction.velocity, prediction.acceleration)
        assert told == pytest.approx(book.x / 1000, abs=1e-9)
        measured = rng.normal(0.1, 0.02)
        ours.update(measured)
        book.update(1000 * measured)
        assert ours.state == pytest.approx(book.x / 1000, abs=1e-9)


@pytest.mark.parametrize("form", FORMS)
def test_gain_and_variance_settle_at_the_riccati_solution(form):
    given = parameters(form)
    f, q = transition(0.1), process_covariance(given, 0.1)
    h = np.array([[1.0, 0.0, 0.0]])
    settled = solve_discrete_are(f.T, h.T, q, [[given.measurement_noise]])
    gain = settled[:, 0] / (settled[0, 0] + given.measurement_noise)

    tracker = MotionFilter(given)
    tracker.reset(0.0)
    for _ in range(400):
        tracker.predict(0.1)
        tracker.update(0.0)
    prediction = tracker.predict(0.1)
    before = tracker.state
    tracker.update(prediction.height + 0.01)
    assert prediction.variance == pytest.approx(settled[0, 0], rel=1e-8)
    assert (tracker.state - before) / 0.01 == pytest.approx(gain, rel=1e-8)


@pytest.mark.slow
@pytest.mark.parametrize("form", FORMS)
def test_innovations_on_its_own_model_are_white_with_the_told_variance(form):
    rng = np.random.default_rng(5)
    given = parameters(form)
    f, q = transition(0.1), process_covariance(given, 0.1)
    runs, steps = 60, 60
    innovations = np.empty((runs, steps))
    for run in range(runs):
        tracker = MotionFilter(given)
        tracker.reset(0.1)
        x = np.array([100.0, 0.0, 0.0]) + rng.standard_normal(3) * given.initial_deviation
        for step in range(steps):
            x = f @ x + rng.multivariate_normal(np.zeros(3), q)
            measured = (x[0] + math.sqrt(given.measurement_noise) * rng.standard_normal()) / 1000
            prediction = tracker.predict(0.1)
            deviation = math.sqrt(prediction.variance + given.measurement_noise)
            innovations[run, step] = 1000 * (measured - prediction.height) / deviation
            tracker.update(measured)
    low, high = chi2.interval(0.999, innovations.size)
    assert low < (innovations**2).sum() < high
    correlation = (innovations[:, 1:] * innovations[:, :-1]).mean()
    assert abs(correlation) < 3.5 / math.sqrt(innovations.size)


@pytest.mark.parametrize("form", FORMS)
def test_prediction_is_exact_for_constant_acceleration_once_settled(form):
    def height(t):
        return 0.05 + 0.2 * t - 0.5 * 0.015 * t**2

    tracker = MotionFilter(parameters(form))
    tracker.reset(height(0.0))
    errors = []
    for k in range(1, 201):
        prediction = tracker.predict(0.1)
        errors.append(abs(prediction.height - height(0.1 * k)))
        tracker.update(height(0.1 * k))
    assert errors[0] > 0.01
    assert max(errors[150:]) < 1e-9
    assert prediction.velocity == pytest.approx(0.2 - 0.015 * 20.0, abs=1e-8)
    assert prediction.acceleration == pytest.approx(-0.015, abs=1e-8)


def test_prediction_is_equation_5_of_the_state():
    tracker = MotionFilter(parameters())
    tracker.reset(0.0)
    for measured in (0.01, 0.03, 0.02):
        tracker.predict(0.1)
        tracker.update(measured)
    s, v, a = tracker.state
    assert a != 0.0
    assert tracker.predict(0.2).height == pytest.approx(s + 0.2 * v + 0.02 * a, rel=1e-12)


def test_prediction_before_a_measurement_is_rest():
    tracker = MotionFilter(parameters())
    tracker.reset(0.12)
    height, _, velocity, acceleration = tracker.predict(0.1)
    assert (height, velocity, acceleration) == (pytest.approx(0.12), 0.0, 0.0)


def test_reset_forgets():
    used, fresh = MotionFilter(), MotionFilter()
    used.reset(0.3)
    for _ in range(5):
        used.predict(0.05)
        used.update(-0.2)
    used.reset(0.1)
    fresh.reset(0.1)
    assert used.predict(0.1) == fresh.predict(0.1)


def test_measurement_noise_is_the_papers_by_default():
    assert MotionFilterParameters().measurement_noise == 0.7


@pytest.mark.parametrize("value", [math.nan, math.inf, -math.inf])
def test_what_is_not_a_number_is_refused_and_leaves_the_state(value):
    tracker = MotionFilter()
    with pytest.raises(ValueError, match="height must be finite"):
        tracker.reset(value)
    tracker.reset(0.1)
    with pytest.raises(ValueError, match="height must be finite"):
        tracker.update(value)
    with pytest.raises(ValueError, match="period must be finite"):
        tracker.predict(value)
    assert tracker.state.tolist() == [0.1, 0.0, 0.0]


@pytest.mark.parametrize("value", [0.0, -1.0, math.nan, math.inf])
@pytest.mark.parametrize("name", ["measurement_noise", "process_noise"])
def test_an_impossible_noise_is_refused(name, value):
    with pytest.raises(InputError, match=f"{name} must be a positive number, got {value}"):
        dataclasses.replace(parameters(), **{name: value})


@pytest.mark.parametrize(
    "deviation",
    [(1.0, 1.0), (1.0, 0.0, 1.0), (1.0, 1.0, -1.0), (math.nan, 1.0, 1.0), (1, 1, math.inf)],
)
def test_an_impossible_deviation_is_refused(deviation):
    with pytest.raises(InputError, match="initial_deviation must be three positive numbers"):
        dataclasses.replace(parameters(), initial_deviation=deviation)


def test_an_unknown_form_of_noise_is_refused():
    with pytest.raises(InputError, match="one of jerk, acceleration, got 'snap'"):
        dataclasses.replace(parameters(), noise_enters="snap")
