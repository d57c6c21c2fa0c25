"""Minimum-jerk strokes are met; what is not one, and rest, is no danger."""

import numpy as np
import pytest
from colift.agents.estimators.minimum_jerk import MinimumJerkStroke
from colift.agents.policies.copy import Copy
from colift.agents.policies.minimum_jerk import MinimumJerk, MinimumJerkParameters
from colift.agents.policies.reactive import Reactive
from colift.base.errors import InputError
from colift.benchmark.episode.lift import Lift
from colift.benchmark.episode.loop import run_episode
from colift.benchmark.suites.catalogue import make_scenario

LIFT = MinimumJerkStroke(start=0.02, end=0.22, onset=1.04, duration=2.1)


def lead(height, until, period=0.1, parameters=None):
    """Return times, commands and internals of a policy that sees heights 0.1 s late."""
    policy = MinimumJerk(parameters=parameters)
    policy.reset(0)
    times = period * np.arange(1 + round(until / period))
    command, commands, told = 0.0, [], []
    for time in times:
        command += float(policy.act(np.array([height(time - 0.1), 0, 0, command, time]))[0])
        commands.append(command)
        told.append(policy.internals())
    return times, np.array(commands), {name: np.array([t[name] for t in told]) for name in told[0]}


@pytest.mark.parametrize("period", [0.05, 0.1])
def test_a_stroke_is_met_when_the_command_takes_effect(period):
    times, commands, _ = lead(LIFT.height, 4.5, period)
    error = np.abs(commands - LIFT.height(times + period + 0.02))
    copied = np.abs(LIFT.height(times - 0.1) - LIFT.height(times + period + 0.02))
    assert np.sqrt(np.mean(error**2)) < 0.2 * np.sqrt(np.mean(copied**2))
    assert error[times > 1.9].max() < 0.15 * copied.max()
    assert error[-1] < 1e-9


def test_the_end_is_foreseen():
    times, _, told = lead(LIFT.height, 4.5)
    late = (times > 2.3) & (times < 3.2)
    assert told["predicted_end"][late] == pytest.approx(np.full(late.sum(), 0.22), abs=0.02)
    assert told["predicted_duration"][late] == pytest.approx(np.full(late.sum(), 2.1), rel=0.2)


def test_at_rest_it_stays_and_says_so():
    times, commands, told = lead(LIFT.height, 6.0)
    before, after = times < 1.1, times > 3.6
    for rest, height in ((before, 0.02), (after, 0.22)):
        assert commands[rest] == pytest.approx(np.full(rest.sum(), height), abs=1e-4)
        assert told["predicted_end"][rest] == pytest.approx(np.full(rest.sum(), height), abs=1e-4)
        assert (told["role"][rest] == 0.0).all()
        assert (told["predicted_duration"][rest] == 0.0).all()
    moving = (times > 1.5) & (times < 3.0)
    assert (told["role"][moving] == 1.0).all()


def test_latency_and_lag_are_looked_ahead():
    """A longer look ahead by 0.1 s is met 0.1 s later."""
    times, commands, _ = lead(LIFT.height, 4.5, parameters=MinimumJerkParameters(lag=0.12))
    late = times > 2.4
    assert commands[late] == pytest.approx(LIFT.height(times[late] + 0.22), abs=6e-3)
    other = lead(LIFT.height, 4.5, parameters=MinimumJerkParameters(latency=0.2))[1]
    assert other == pytest.approx(commands, abs=1e-12)


def test_surprises_widen_the_spread_and_are_forgotten():
    def height(time):
        return 0.1 * min(max(time - 1.0, 0.0), 1.0)

    times, _, told = lead(height, 6.0)
    assert told["spread"][times < 1.0] == pytest.approx(0.0007)
    assert told["spread"][(times > 1.0) & (times < 2.5)].max() > 0.002
    assert told["spread"][-1] == pytest.approx(0.0007, rel=0.05)


def test_moving_from_the_first_sample_on_is_no_danger():
    times, commands, _ = lead(lambda time: 0.1 * (time + 1.0), 1.0)
    assert np.isfinite(commands).all()
    assert np.abs(commands - 0.1 * (times + 1.0)).max() < 0.04


def test_a_clock_that_is_set_back_begins_anew():
    set_back, fresh = MinimumJerk(), MinimumJerk()
    set_back.reset(0)
    fresh.reset(0)
    for k in range(20):
        set_back.act(np.array([0.01 * k, 0.0, 0.0, 0.0, 50.0 + 0.1 * k]))
    for k in range(20):
        view = np.array([LIFT.height(0.5 + 0.1 * k), 0.0, 0.0, 0.0, 0.1 * k])
        assert set_back.act(view) == fresh.act(view)
    assert set_back.internals() == fresh.internals()


def test_up_and_down_are_alike():
    commands = lead(LIFT.height, 4.0)[1]
    assert lead(lambda time: -LIFT.height(time), 4.0)[1] == pytest.approx(-commands, abs=1e-9)


def test_it_beats_a_copy_and_the_reactive_controller_on_smooth_lifts():
    for subject in ("S1", "S4"):
        lift = Lift(make_scenario("smooth", subject))
        for seed in (60000, 60001):
            episodes = [
                run_episode(lift, policy(), seed) for policy in (MinimumJerk, Copy, Reactive)
            ]
            assert episodes[0].failure is None
            ours, copied, reactive = (episode.scores["rmse_mm"] for episode in episodes)
            assert ours < 0.4 * copied
            assert ours < 0.4 * reactive


@pytest.mark.parametrize("behaviour", ["pause", "jerky", "changing_goal"])
def test_it_beats_a_copy_where_the_model_fails(behaviour):
    lift = Lift(make_scenario(behaviour, "S2"))
    for seed in (60000, 60001):
        ours, copied = (run_episode(lift, policy(), seed) for policy in (MinimumJerk, Copy))
        assert ours.failure is None
        assert ours.scores["rmse_mm"] < 0.85 * copied.scores["rmse_mm"]


@pytest.mark.parametrize("name", ["latency", "lag"])
@pytest.mark.parametrize("value", [-0.1, np.inf, np.nan])
def test_impossible_parameters_are_refused(name, value):
    with pytest.raises(InputError, match=f"{name} must be a number of at least 0, got {value}"):
        MinimumJerkParameters(**{name: value})
