"""From a log to an episode: scores of what motion capture saw, and of what was stopped."""

import math

import numpy as np
import pytest
from colift.agents.hardware.ports import HandLimits, Sample
from colift.agents.hardware.stops import Stop
from colift.agents.hardware.trial_log import LoggedTrial, Step, TrialLog
from colift.base.errors import InputError
from colift.benchmark.bundle import results
from colift.benchmark.bundle.table import dump_table
from colift.benchmark.episode.metric import Metric
from colift.benchmark.hardware.estimates import estimate_setup
from colift.benchmark.hardware.strokes import find_strokes, smoothed
from colift.benchmark.hardware.timing import timing_report
from colift.benchmark.hardware.trial import episode, hardware_run, hardware_suite
from colift.benchmark.tasks.level.table import LEVEL_METRICS
from colift.benchmark.tasks.level.task import Level

T = 0.1


def step(k, *, late=0.0, hold="", **values):
    """Return the k-th step, on time or late."""
    ordinary = dict.fromkeys(Step._fields, 0.0)
    deadline = T + k * T
    return Step(
        **{**ordinary, "time": deadline + late, "deadline": deadline, "hold": hold, **values}
    )


def log(seconds, human, robot, **settings):
    """Return a trial with frames at 100 Hz of these heights over time [m]."""
    made = TrialLog(period=T, latency=0.1, **settings)
    steps = round(seconds / T)
    frames = [Sample(0.01 * k, human(0.01 * k), robot(0.01 * k)) for k in range(10 * steps + 30)]
    made.events = [*frames, *(step(k, policy_time=0.002) for k in range(steps))]
    return made


def up_and_down(t):
    """Rise by 0.2 m from 1 to 2 s, and down from 3 to 4 s, by minimum jerk."""

    def rise(s):
        s = min(max(s, 0.0), 1.0)
        return 10 * s**3 - 15 * s**4 + 6 * s**5

    return 0.2 * (rise(t - 1) - rise(t - 3))


def test_the_error_is_that_of_the_heights_over_the_whole_trial():
    played = episode(log(5.0, up_and_down, lambda t: up_and_down(t) - 0.01), person="Ann", number=3)
    assert played.scores["rmse_mm"] == pytest.approx(10.0)
    assert played.scores["abs_error_mm"] == pytest.approx(10.0 * 500)
    assert (played.subject, played.seed, played.failure) == ("Ann", 3, None)
    assert len(played.trace.human_end) == 500
    assert math.isnan(played.scores["human_force_n"])
    assert played.step_times == (0.002,) * 50


def test_the_lag_of_the_robots_end_is_found():
    played = episode(log(5.0, up_and_down, lambda t: up_and_down(t - 0.15)), person="Ann", number=0)
    assert played.scores["robot_lag_ms"] == pytest.approx(150, abs=10)


def test_smoothness_is_of_the_strokes_and_jerky_is_worse():
    def jerky(t):
        return up_and_down(t) + 0.004 * math.sin(30 * t)

    smooth = episode(log(5.0, up_and_down, up_and_down), person="Ann", number=0).scores
    rough = episode(log(5.0, up_and_down, jerky), person="Ann", number=0).scores
    assert rough["sparc"] < smooth["sparc"] - 0.3
    assert rough["ldlj"] < smooth["ldlj"] - 0.5


def test_a_stopped_trial_has_failed_and_a_stop_never_pays():
    stopped = log(2.0, up_and_down, up_and_down, stop=Stop.OPERATOR, reason="the Enter key")
    played = episode(stopped, person="Ann", number=0)
    assert played.failure == "OPERATOR: the Enter key"
    # Four of six seconds at 250 mm.
    assert played.scores["rmse_mm"] == pytest.approx(250 * math.sqrt(4 / 6), rel=1e-3)
    at_once = TrialLog(period=T, latency=0.1, stop=Stop.ROBOT_LOST, reason="gone")
    assert episode(at_once, person="Ann", number=0).scores["rmse_mm"] == pytest.approx(250)


def test_strokes_are_the_movements_and_nothing_else():
    heights = np.array([up_and_down(0.01 * k) for k in range(500)])
    noisy = heights + np.random.default_rng(1).normal(0, 0.00023, 500)
    for seen in (heights, noisy):
        (rise, fall) = find_strokes(smoothed(seen))
        assert rise == pytest.approx((110, 190), abs=12)
        assert fall == pytest.approx((310, 390), abs=12)
    assert find_strokes(smoothed(np.random.default_rng(1).normal(0, 0.00023, 500))) == ()


def test_a_suite_of_the_laboratory_cannot_be_simulated():
    suite = hardware_suite("NAO trials", "Ann", 2, period=0.1, latency=0.1)
    with pytest.raises(InputError, match="nobody knows the person's plan"):
        suite.scenarios[0].human.plan(suite.scenarios[0].subject, 0)


def test_the_latency_report_counts_and_measures():
    made = TrialLog(period=T, latency=0.1, late_steps=2)
    made.events = [
        step(0, action=0.01, policy_time=0.001, sensing_age=0.02),
        step(1, action=0.01, policy_time=0.003, sensing_age=0.03, late=0.004),
        step(
            2, action=math.nan, policy_time=0.06, sensing_age=math.inf, hold="the policy was late"
        ),
    ]
    report = timing_report([made])
    assert report["policy_ms"] == pytest.approx({"p50": 2.0, "p99": 2.98, "max": 3.0})
    assert report["sensing_age_ms"]["max"] == pytest.approx(30.0)
    assert report["period_error_ms"] == pytest.approx({"p50": 4.0, "p99": 4.0, "max": 4.0})
    assert (report["late_steps"], report["held"]) == (
        2,
        {"the policy was late": 1, "a period was skipped": 2},
    )
    empty = timing_report([TrialLog(period=T, latency=0.1)])
    assert empty["period_error_ms"] == {"p50": None, "p99": None, "max": None}


def test_trials_that_say_nothing_are_refused_by_what_they_lack():
    limits = HandLimits(low=-0.03, high=0.29, speed=0.4, tilt=0.14)

    def recorded(made):
        return LoggedTrial(policy="hold", limits=limits, weight_offset=0.0, log=made)

    with pytest.raises(InputError, match="5 steps are too few"):
        estimate_setup([recorded(log(0.5, up_and_down, up_and_down))])
    with pytest.raises(InputError, match="commanded to move by less than 30 mm"):
        estimate_setup([recorded(log(5.0, up_and_down, up_and_down))])


def with_metrics(monkeypatch, **added):
    """Add metrics to ``level``, as somebody would: an entry in its table, and a value each."""
    score = Level.score

    def scored(self, lift, trace, *, failed):
        values = {name: float(value(lift, trace)) for name, (_, value) in added.items()}
        return {**score(self, lift, trace, failed=failed), **values}

    monkeypatch.setattr(Level, "score", scored)
    for name, (missing, _) in added.items():
        metric = Metric(
            name=name, symbol=name, label=name, missing=missing, limit=3.0, meaning="new"
        )
        monkeypatch.setitem(LEVEL_METRICS, name, metric)


@pytest.mark.parametrize("missing", ["worst", "left out"])
@pytest.mark.parametrize("stopped", [False, True])
def test_a_new_metric_of_level_has_a_value_in_a_trial_if_motion_capture_gives_it(
    monkeypatch, missing, stopped
):
    with_metrics(
        monkeypatch,
        peak_m=(missing, lambda lift, trace: trace.robot_end.max()),
        pull=(missing, lambda lift, trace: (trace.human_force > 0).sum()),
        overshoot=(missing, lambda lift, trace: trace.robot_end.max() - lift.plan.goal),
        work=(missing, lambda lift, trace: (trace.robot_force * trace.human_velocity).sum()),
    )
    stop = {"stop": Stop.OPERATOR, "reason": "the Enter key"} if stopped else {}
    lifts = [
        episode(log(5.0, up_and_down, up_and_down, **stop), person="Ann", number=number)
        for number in range(2)
    ]
    assert list(lifts[0].scores) == list(LEVEL_METRICS)
    assert lifts[0].scores["peak_m"] == pytest.approx(0.2, rel=1e-3)
    for unknown in ("pull", "overshoot", "work"):
        assert math.isnan(lifts[0].scores[unknown])
    suite = hardware_suite("NAO", "Ann", 2, period=T, latency=0.1)
    run = hardware_run("copy", "0" * 16, suite, lifts, "none")
    summary = results(run, {}).plain()["summary"]
    assert summary["pull"] == {"mean": None, "missing": 2}
    assert summary["peak_m"] == {"mean": pytest.approx(0.2, rel=1e-3), "missing": 0}
    assert b"peak_m" in dump_table(lifts, suite.metrics)


def test_a_metric_that_level_no_longer_has_is_left_out(monkeypatch):
    fewer = {name: each for name, each in LEVEL_METRICS.items() if name != "sparc"}
    monkeypatch.setattr(Level, "metrics", fewer)
    assert "sparc" not in episode(log(5.0, up_and_down, up_and_down), person="A", number=0).scores
