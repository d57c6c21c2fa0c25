"""Smoothness agrees with the authors' code, and what does not move earns none.

The expected values are those of ``sparc()``, ``dimensionless_jerk()`` and
``log_dimensionless_jerk()`` in ``scripts/smoothness.py`` of github.com/siva82kb/SPARC (commit
3650934f), run on the signals below.
"""

import math

import numpy as np
import pytest
from colift.base.errors import InputError
from colift.benchmark.episode.smoothness import dimensionless_jerk, ldlj, sparc
from numpy.typing import NDArray

Signal = NDArray[np.float64]


def seconds(frames: int) -> Signal:
    return np.arange(frames) / 100


def minimum_jerk_position(s: Signal) -> Signal:
    s = np.clip(s, 0, 1)
    return 10 * s**3 - 15 * s**4 + 6 * s**5


def minimum_jerk_speed(s: Signal) -> Signal:
    s = np.clip(s, 0, 1)
    return 30 * s**2 - 60 * s**3 + 30 * s**4


def staircase() -> Signal:
    """Rise by 2 cm every 100 ms, ten times: the paper's reactive robot."""
    t = seconds(121)
    steps = np.clip(np.floor((t - 0.1 + 1e-9) / 0.1) + 1, 0, 10)
    return 0.02 * np.where(t < 0.1, 0, steps)


def gradient_speed(height: Signal) -> Signal:
    return np.abs(np.gradient(height, 0.01))


T101, T141, T201, T601 = seconds(101), seconds(141), seconds(201), seconds(601)
TREMOR = 2 * np.pi * 8 * T201

SPEED = {
    "gaussian": np.exp(-5 * np.arange(-1, 1, 0.01) ** 2),
    "minimum jerk": 0.20 * minimum_jerk_speed(T101),
    "two submovements": 0.12 / 0.8 * minimum_jerk_speed(T141 / 0.8)
    + 0.08 / 0.8 * minimum_jerk_speed((T141 - 0.6) / 0.8),
    "tremor": np.abs(0.10 * minimum_jerk_speed(T201 / 2) + 0.001 * 2 * np.pi * 8 * np.cos(TREMOR)),
    "staircase": gradient_speed(staircase()),
    "ramp": np.full(201, 0.10),
    "lift, hold, lower": 0.10 * minimum_jerk_speed(T601 / 2)
    + 0.10 * minimum_jerk_speed((T601 - 4) / 2),
}
HEIGHT = {
    "minimum jerk": 0.20 * minimum_jerk_position(T101),
    "two submovements": 0.12 * minimum_jerk_position(T141 / 0.8)
    + 0.08 * minimum_jerk_position((T141 - 0.6) / 0.8),
    "tremor": 0.20 * minimum_jerk_position(T201 / 2) + 0.001 * np.sin(TREMOR),
    "staircase": staircase(),
    "ramp": 0.10 * T201,
}

# signal, fc [Hz], amp_th, SPARC
SPARC_REFERENCE = [
    ("gaussian", 10, 0.05, -1.414031261710479),
    ("minimum jerk", 10, 0.05, -1.4058293244214652),
    ("minimum jerk", 10, 0.01, -1.6403696750058883),
    ("minimum jerk", 20, 0.05, -1.4058293244214652),
    ("minimum jerk", 20, 0.01, -1.6403696750058883),
    ("two submovements", 10, 0.05, -1.748790728505758),
    ("two submovements", 10, 0.01, -1.9391348391808385),
    ("two submovements", 20, 0.05, -1.748790728505758),
    ("two submovements", 20, 0.01, -1.9391348391808385),
    ("tremor", 10, 0.05, -2.257770973910558),
    ("tremor", 10, 0.01, -2.3930123468844124),
    ("tremor", 20, 0.05, -2.257770973910558),
    ("tremor", 20, 0.01, -2.780795551749278),
    ("staircase", 10, 0.05, -4.3244108443480584),
    ("staircase", 10, 0.01, -4.3244108443480584),
    ("staircase", 20, 0.05, -7.959120002593196),
    ("staircase", 20, 0.01, -7.959120002593196),
    ("ramp", 10, 0.05, -2.4037627823450802),
    ("ramp", 10, 0.01, -3.1740380107379043),
    ("ramp", 20, 0.05, -2.4037627823450802),
    ("ramp", 20, 0.01, -3.4858686260283758),
    ("lift, hold, lower", 10, 0.05, -3.9935401349409534),
    ("lift, hold, lower", 20, 0.05, -3.9935401349409534),
]
SPARC_OF_GRADIENT_REFERENCE = [
    ("minimum jerk", -1.4058919425048795),
    ("two submovements", -1.7484647535204452),
    ("tremor", -2.238633008743099),
    ("staircase", -4.3244108443480584),
    ("ramp", -2.40376278234508),
]
JERK_REFERENCE = [
    ("gaussian", -335.7468370326857),
    ("minimum jerk", -200.66427703333662),
    ("two submovements", -1611.9170405915074),
    ("tremor", -3788509.98425542),
    ("staircase", -70862439.99999988),
    ("ramp", 0.0),
]
LDLJ_REFERENCE = [
    ("gaussian", -5.816357414756398),
    ("minimum jerk", -5.30163324809806),
    ("two submovements", -7.385179458089364),
    ("tremor", -15.147483355761317),
    ("staircase", -18.076251090904158),
    ("lift, hold, lower", -9.297212832327789),
]


@pytest.mark.parametrize(("name", "fc", "amp_th", "expected"), SPARC_REFERENCE)
def test_sparc_agrees_with_the_authors_code(
    name: str, fc: float, amp_th: float, expected: float
) -> None:
    assert sparc(SPEED[name], fc=fc, amp_th=amp_th) == pytest.approx(expected, rel=1e-6)


@pytest.mark.parametrize(("name", "expected"), SPARC_OF_GRADIENT_REFERENCE)
def test_sparc_of_differentiated_heights_agrees_with_the_authors_code(
    name: str, expected: float
) -> None:
    assert sparc(gradient_speed(HEIGHT[name]), fc=10) == pytest.approx(expected, rel=1e-6)


@pytest.mark.parametrize(("name", "expected"), JERK_REFERENCE)
def test_dimensionless_jerk_agrees_with_the_authors_code(name: str, expected: float) -> None:
    assert dimensionless_jerk(SPEED[name]) == pytest.approx(expected, rel=1e-6)


@pytest.mark.parametrize(("name", "expected"), LDLJ_REFERENCE)
def test_ldlj_agrees_with_the_authors_code(name: str, expected: float) -> None:
    assert ldlj(SPEED[name]) == pytest.approx(expected, rel=1e-6)


def test_sparc_uses_20_hz_and_5_percent_by_default() -> None:
    assert sparc(SPEED["staircase"]) == sparc(SPEED["staircase"], fs=100.0, fc=20.0, amp_th=0.05)


@pytest.mark.parametrize("metric", [sparc, dimensionless_jerk, ldlj])
class TestEveryMetric:
    def test_does_not_depend_on_the_size_of_the_movement(self, metric) -> None:
        v = SPEED["two submovements"]
        assert metric(3 * v) == pytest.approx(metric(v), rel=1e-9)

    def test_does_not_depend_on_the_units_of_time(self, metric) -> None:
        v = SPEED["two submovements"]
        slower = {"fs": 50.0, "fc": 10.0} if metric is sparc else {"fs": 50.0}
        assert metric(v / 2, **slower) == pytest.approx(metric(v), rel=1e-9)

    def test_ranks_one_movement_above_two_above_a_trembling_one_above_a_staircase(
        self, metric
    ) -> None:
        order = ["minimum jerk", "two submovements", "tremor", "staircase"]
        scores = [metric(SPEED[name]) for name in order]
        assert scores == sorted(scores, reverse=True)

    @pytest.mark.parametrize(
        "speed",
        [
            np.zeros(200),
            np.full(200, 0.5e-3),
            0.5e-3 * minimum_jerk_speed(T101) / 1.875,
            SPEED["minimum jerk"][48:52],
            np.empty(0),
        ],
        ids=["zero", "creeping", "tiny but smooth", "four samples", "no samples"],
    )
    def test_what_does_not_move_has_none(self, metric, speed: Signal) -> None:
        assert math.isnan(metric(speed))

    def test_rejects_what_is_not_a_profile(self, metric) -> None:
        with pytest.raises(InputError, match="sample 3 is not a finite"):
            metric([0.1, 0.2, 0.3, math.nan, 0.1])
        with pytest.raises(InputError, match=r"shape \(2, 50\)"):
            metric(np.ones((2, 50)))


@pytest.mark.parametrize("speed", [SPEED["ramp"], gradient_speed(HEIGHT["ramp"])])
def test_a_speed_without_jerk_has_no_ldlj_rather_than_an_infinite_one(speed: Signal) -> None:
    assert math.isnan(ldlj(speed))


def test_minimum_jerk_has_its_theoretical_dimensionless_jerk() -> None:
    # The integral of (d2v/ds2)^2 with v = 30 s^2 - 60 s^3 + 30 s^4 is 720, its peak speed 1.875.
    fine = minimum_jerk_speed(np.linspace(0, 1, 20001))
    assert dimensionless_jerk(fine, fs=20000.0) == pytest.approx(-720 / 1.875**2, rel=1e-3)


def test_rest_at_the_ends_hardly_changes_sparc() -> None:
    v = SPEED["two submovements"]
    padded = np.concatenate([np.zeros(40), v, np.zeros(30)])
    assert sparc(padded) == pytest.approx(sparc(v), rel=0.01)
    assert ldlj(padded) < ldlj(v) - 1


def test_sparc_rejects_a_limit_above_half_the_sampling_rate() -> None:
    with pytest.raises(InputError, match="fc is 60"):
        sparc(SPEED["minimum jerk"], fc=60)
