import numpy as np
import pytest
from colift.agents.agent import FRAME
from colift.agents.estimators.minimum_jerk import profile
from colift.agents.humans import SUBJECTS, Recorded, Recording
from colift.base.errors import InputError

S1 = SUBJECTS["S1"]


def record(height, duration=3.0, rate=100.0):
    """Record a height(t)."""
    t = np.arange(round(duration * rate) + 1) / rate
    return Recording(name="trial", times=tuple(t.tolist()), heights=tuple(height(t).tolist()))


def lift(t):
    return 0.7 * (profile(t) - profile(t - 1.8))


def plan(recording, seed=0):
    return Recorded(recording=recording).plan(S1, seed)


def speed(plan):
    return np.abs(np.diff(plan.target)) / FRAME


def test_a_recording_is_scaled_to_its_peak_and_slowed_down():
    result = plan(record(lift))
    assert result.goal == pytest.approx(0.20, abs=1e-4)
    assert 0.18 < speed(result).max() <= 0.20


def test_shape_survives():
    result = plan(record(lift))
    (start, stop), _ = result.strokes
    stretch = 0.20 * 1.875 / 0.20
    t = np.arange(len(result.target)) * FRAME / stretch
    middle = np.searchsorted(result.target[start:stop], 0.10) + start
    expected = 0.20 * profile(t - t[middle] + 0.5)[start:stop]
    assert np.abs(result.target[start:stop] - expected).max() < 0.008


def test_a_slow_recording_is_not_sped_up():
    result = plan(record(lambda t: lift(t / 4.0), duration=12.0))
    times = [np.flatnonzero(result.target > 0.1)[index] * FRAME for index in (0, -1)]
    assert times[1] - times[0] == pytest.approx(4.0 * 1.8, abs=0.05)


def test_a_recording_of_a_deposit_is_turned_into_a_lift():
    up, down = plan(record(lift)), plan(record(lambda t: 1.3 - lift(t)))
    assert down.target == pytest.approx(up.target, abs=1e-9)


def test_a_deep_dip_below_the_start_is_kept_in_the_room_there():
    def dipping(t):
        return lift(t - 1.0) - 0.3 * np.sin(np.pi * np.clip(t, 0.0, 1.0)) ** 2

    result = plan(record(dipping, duration=4.0))
    assert result.target.min() == pytest.approx(-0.03, abs=2e-4)
    assert result.goal == pytest.approx(0.03 * 0.7 / 0.3, rel=0.03)


def test_a_recording_that_ends_high_and_in_motion_comes_back_without_a_halt():
    result = plan(record(lift, duration=2.3))
    assert np.abs(result.target[-60:]).max() < 1e-12
    acceleration = np.diff(result.target, 2) / FRAME**2
    assert np.abs(acceleration).max() < 1.5
    assert len(result.strokes) == 2


def test_a_recording_that_begins_in_motion_starts_from_rest():
    result = plan(record(lambda t: lift(t + 0.3)))
    velocity = np.diff(result.target) / FRAME
    assert np.abs(np.diff(velocity)).max() < 1.5 * FRAME


def test_measurement_noise_does_not_become_jerk():
    rng = np.random.default_rng(1)
    clean = plan(record(lift))
    noisy = plan(record(lambda t: lift(t) + 1e-3 * rng.standard_normal(len(t))))
    roughness = [np.std(np.diff(p.target, 2)) / FRAME**2 for p in (clean, noisy)]
    assert roughness[1] < 1.2 * roughness[0]


def test_the_rate_of_the_recording_does_not_matter():
    fine, coarse = plan(record(lift)), plan(record(lift, rate=30.0))
    assert len(fine.target) == pytest.approx(len(coarse.target), abs=40)
    assert np.abs(np.diff(coarse.target, 3)).max() / FRAME**3 < 30.0


def test_the_strokes_are_the_movements():
    result = plan(record(lift))
    names = [name for name, _ in result.events]
    assert names == ["ready", "begin", "rise", "hold", "lower", "end", "rest"]
    (up_start, up_stop), (down_start, down_stop) = result.strokes
    assert result.target[up_start - 1] < 0.003
    assert result.target[up_stop - 1] > 0.197
    assert result.target[down_start] > 0.197
    assert result.target[down_stop - 1] < 0.003


def test_the_seed_changes_the_rests_only():
    first, second = (plan(record(lift), seed) for seed in (1, 2))
    moves = [p.target[p.strokes[0][0] : p.strokes[-1][1]] for p in (first, second)]
    assert np.array_equal(*moves)
    assert first.strokes[0][0] != second.strokes[0][0]


def test_the_subject_does_not_matter():
    behaviour = Recorded(recording=record(lift))
    assert np.array_equal(behaviour.plan(S1, 0).target, behaviour.plan(SUBJECTS["S3"], 0).target)


def test_a_lone_outlier_is_no_lift():
    def outlier(t):
        return 0.02 * (np.abs(t - 1.01) < 0.005)

    with pytest.raises(InputError, match="'trial' does not move: after smoothing"):
        plan(record(outlier))
