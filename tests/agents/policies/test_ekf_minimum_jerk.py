"""The assistance is the share of the filter's motion that is taken on."""

import numpy as np
import pytest
from colift.agents.estimators.minimum_jerk import MinimumJerkStroke
from colift.agents.estimators.minimum_jerk_filter import MinimumJerkFilter
from colift.agents.policies.copy import Copy
from colift.agents.policies.ekf_minimum_jerk import EkfMinimumJerk, EkfMinimumJerkParameters
from colift.agents.policies.reactive import Reactive
from colift.base.errors import InputError
from colift.benchmark.episode.lift import Lift
from colift.benchmark.episode.loop import run_episode
from colift.benchmark.suites.catalogue import make_scenario

LIFT = MinimumJerkStroke(start=0.02, end=0.22, onset=1.04, duration=2.1)


def assist(height, until, period=0.1, **values):
    """Return times, commands and internals of a policy that sees heights 0.1 s late."""
    policy = EkfMinimumJerk(parameters=EkfMinimumJerkParameters(**values))
    policy.reset(0)
    times = period * np.arange(1 + round(until / period))
    command, commands, told = 0.0, [], []
    for time in times:
        command += float(policy.act(np.array([height(time - 0.1), 0, 0, command, time]))[0])
        commands.append(command)
        told.append(policy.internals())
    return times, np.array(commands), {name: np.array([t[name] for t in told]) for name in told[0]}


@pytest.mark.parametrize("assistance", [0.0, 0.3, 0.9, 1.0])
def test_the_command_is_what_is_seen_and_the_share_of_the_predicted_motion(assistance):
    times, commands, told = assist(LIFT.height, 4.0, assistance=assistance)
    seen = LIFT.height(times - 0.1)
    motion = told["prediction"] - seen
    assert np.abs(motion).max() > 0.03
    assert commands == pytest.approx(seen + assistance * motion, abs=1e-12)
    assert (told["role"] == assistance).all()


@pytest.mark.parametrize("period", [0.05, 0.1])
def test_with_full_assistance_a_stroke_is_met_when_the_command_takes_effect(period):
    times, commands, _ = assist(LIFT.height, 5.0, period, assistance=1.0)
    error = np.abs(commands - LIFT.height(times + period + 0.02))
    copied = np.abs(LIFT.height(times - 0.1) - LIFT.height(times + period + 0.02))
    assert np.sqrt(np.mean(error**2)) < 0.3 * np.sqrt(np.mean(copied**2))
    assert error[-1] < 1e-9


def test_the_prediction_is_the_filters_after_the_rest():
    """From the last sample at rest on, the filter alone sees the samples."""
    times, _, told = assist(LIFT.height, 2.5)
    tracker = MinimumJerkFilter()
    tracker.reset(0.02)
    moving = told["time_to_go"] < told["time_to_go"][0] - 0.05
    for time in times[moving]:
        tracker.predict(0.1)
        tracker.update(float(LIFT.height(time - 0.1)))
    expected = tracker.ahead(0.22)
    assert told["prediction"][-1] == pytest.approx(expected[0], abs=1e-3)
    assert told["predicted_velocity"][-1] == pytest.approx(expected[1], abs=1e-2)


def test_the_end_is_foreseen():
    times, _, told = assist(LIFT.height, 4.5)
    late = (times > 2.5) & (times < 3.2)
    assert told["predicted_end"][late] == pytest.approx(np.full(late.sum(), 0.22), abs=0.03)
    assert told["time_to_go"][times < 1.0].min() > 1.9
    assert told["time_to_go"][(times > 2.95) & (times < 3.15)].max() < 1.2


def test_at_rest_it_stays():
    times, commands, told = assist(LIFT.height, 6.0)
    for rest, height in ((times < 1.1, 0.02), (times > 3.7, 0.22)):
        assert commands[rest] == pytest.approx(np.full(rest.sum(), height), abs=1e-4)
        assert told["predicted_end"][rest] == pytest.approx(np.full(rest.sum(), height), abs=1e-4)
        assert told["predicted_velocity"][rest] == pytest.approx(np.zeros(rest.sum()), abs=1e-9)


def test_a_clock_that_is_set_back_begins_anew():
    set_back, fresh = EkfMinimumJerk(), EkfMinimumJerk()
    set_back.reset(0)
    fresh.reset(0)
    for k in range(20):
        set_back.act(np.array([0.01 * k, 0.0, 0.0, 0.0, 50.0 + 0.1 * k]))
    for k in range(20):
        view = np.array([LIFT.height(0.5 + 0.1 * k), 0.0, 0.0, 0.0, 0.1 * k])
        assert set_back.act(view) == fresh.act(view)
    assert set_back.internals() == fresh.internals()


def test_up_and_down_are_alike():
    commands = assist(LIFT.height, 4.0)[1]
    assert assist(lambda time: -LIFT.height(time), 4.0)[1] == pytest.approx(-commands, abs=1e-9)


def test_latency_and_lag_are_looked_ahead():
    one = assist(LIFT.height, 4.0, latency=0.2, lag=0.0)[1]
    other = assist(LIFT.height, 4.0, latency=0.1, lag=0.1)[1]
    assert one == pytest.approx(other, abs=1e-12)
    assert (one - assist(LIFT.height, 4.0, latency=0.1, lag=0.0)[1]).max() > 0.008


@pytest.mark.parametrize("behaviour", ["smooth", "pause", "changing_goal"])
def test_it_beats_a_copy_and_the_reactive_controller(behaviour):
    lift = Lift(make_scenario(behaviour, "S3"))
    for seed in (60000, 60001):
        episodes = [
            run_episode(lift, policy(), seed) for policy in (EkfMinimumJerk, Copy, Reactive)
        ]
        assert episodes[0].failure is None
        ours, copied, reactive = (episode.scores["rmse_mm"] for episode in episodes)
        assert ours < 0.6 * copied
        assert ours < 0.6 * reactive


def test_more_assistance_is_more_level_than_little():
    lift = Lift(make_scenario("smooth", "S1"))
    policies = [
        EkfMinimumJerk(parameters=EkfMinimumJerkParameters(assistance=assistance))
        for assistance in (0.0, 0.5, 0.9)
    ]
    rmse = [run_episode(lift, policy, 60000).scores["rmse_mm"] for policy in policies]
    assert rmse[0] > 1.3 * rmse[1] > 1.3**2 * rmse[2]


@pytest.mark.parametrize(
    ("values", "message"),
    [
        ({"assistance": -0.1}, r"assistance must be in \[0, 1\], got -0.1"),
        ({"assistance": 1.01}, r"assistance must be in \[0, 1\], got 1.01"),
        ({"assistance": np.nan}, r"assistance must be in \[0, 1\], got nan"),
        ({"latency": -0.1}, "latency must be a number of at least 0, got -0.1"),
        ({"lag": np.inf}, "lag must be a number of at least 0, got inf"),
    ],
)
def test_impossible_parameters_are_refused(values, message):
    with pytest.raises(InputError, match=message):
        EkfMinimumJerkParameters(**values)
