import numpy as np
import pytest
from colift.agents.control.anticipation import ARM_LAG, FeatureHistory, FeatureWindow
from colift.base.errors import InputError


def view(human, hand, command, time):
    return np.array([human, 0.0, hand, command, time])


def seen(window, times, human, hand, command):
    history = FeatureHistory(window)
    for time in times:
        history.add(view(human(time), hand(time), command(time), time))
    return history


def test_inputs_are_height_differences_the_newest_first():
    history = FeatureHistory(FeatureWindow(velocities=3))
    for k, height in enumerate((0.0, 0.01, 0.03, 0.07)):
        history.add(view(height, 0.0, 0.002 * k, 0.1 * k))
    assert history.features() == pytest.approx([0.07, 0.04, 0.02, 0.01])


def test_the_sag_is_how_far_the_hand_is_below_where_it_has_come_to():
    history = FeatureHistory(FeatureWindow(velocities=3))
    for k in range(4):
        history.add(view(0.0, 0.001, 0.002 * k, 0.1 * k))
    command = 0.004 + 0.002 * (0.1 - ARM_LAG) / 0.1
    assert history.sag == pytest.approx(command - 0.001)


def test_before_the_first_sample_nothing_moved():
    history = FeatureHistory(FeatureWindow(velocities=4))
    history.add(view(0.05, 0.01, 0.02, 7.0))
    assert history.features() == pytest.approx([0.05, 0, 0, 0, 0])
    assert history.sag == pytest.approx(0.01)


def test_other_periods_are_interpolated_to_the_interval():
    """A steady motion gives the same inputs whatever the period."""
    window = FeatureWindow(velocities=5)

    def steady(period):
        times = period * np.arange(round(2.0 / period) + 1)
        return seen(window, times, lambda t: 0.1 * t, lambda t: 0.1 * t - 0.003, lambda t: 0.1 * t)

    wanted = steady(0.1).features()
    for period in (0.02, 0.05):
        assert steady(period).features() == pytest.approx(wanted, abs=1e-12)


def test_a_hand_that_follows_with_the_arms_lag_does_not_sag():
    times = 0.1 * np.arange(10)
    history = seen(
        FeatureWindow(),
        times,
        lambda t: 0.0,
        lambda t: max(0.1 * (t - ARM_LAG), 0.0),
        lambda t: 0.1 * t,
    )
    assert history.sag == pytest.approx(0.0, abs=1e-12)


def test_the_past_is_kept_as_long_as_the_window_needs_and_no_longer():
    window = FeatureWindow(velocities=3)
    times = 0.02 * np.arange(500)
    history = seen(window, times, lambda t: t * t, lambda t: 0.0, lambda t: 0.0)
    fresh = seen(window, times[-60:], lambda t: t * t, lambda t: 0.0, lambda t: 0.0)
    assert history.features() == pytest.approx(fresh.features())
    assert len(history._times) < 60


@pytest.mark.parametrize("wrong", [{"interval": 0.0}, {"velocities": 0}, {"interval": np.nan}])
def test_a_window_without_sense_is_refused(wrong):
    with pytest.raises(InputError):
        FeatureWindow(**wrong)
