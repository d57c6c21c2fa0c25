"""Tilt and shaking: what is stopped although each command is allowed."""

import math

import pytest
from colift.agents.hardware.conduct import Conduct, reversed_path
from colift.agents.hardware.ports import Sample
from colift.agents.hardware.stops import Stop, StopTrialError

TILT = 0.14


@pytest.mark.parametrize(
    ("commands", "back"),
    [
        ([0.1], 0.0),
        ([0.0, 0.04, 0.08, 0.12], 0.0),
        ([0.0, 0.1, 0.0], 0.1),
        ([0.0, 0.04] * 5, 0.32),
    ],
)
def test_the_way_back_is_the_path_less_the_range(commands, back):
    assert reversed_path(commands) == pytest.approx(back)


def shaken(swing, period=0.1, seconds=3.0, turn=1):
    """Return when commands that turn around every few steps are stopped [s], and as what."""
    conduct = Conduct(TILT)
    for k in range(round(seconds / period)):
        try:
            conduct.commands(k * period, swing * ((k // turn) % 2))
        except StopTrialError as stop:
            return k * period, stop.stop
    return None


def test_shaking_is_stopped_within_a_second_at_any_control_period():
    for times in ({}, {"swing": 0.008, "period": 0.02}):
        stopped, stop = shaken(**{"swing": 0.04, **times})
        assert 0.5 < stopped <= 1.0
        assert stop is Stop.POLICY


def test_small_and_slow_movements_are_not_shaking():
    assert shaken(0.02) is None
    assert shaken(0.2, turn=10) is None


def test_a_command_tilts_the_table_no_further_and_moves_no_hands_that_would_stay():
    conduct = Conduct(TILT)
    assert conduct.level(0.1, 0.06, 0.0) == 0.1
    assert conduct.level(0.17, 0.13, 0.0) == TILT
    assert conduct.level(-0.03, 0.01, 0.2) == 0.01
    # The person has lifted further: staying, and coming after, are both allowed.
    assert conduct.level(0.0, 0.0, 0.25) == 0.0
    assert conduct.level(0.04, 0.0, 0.25) == 0.04
    assert conduct.level(-0.02, 0.0, 0.25) == 0.0
    assert Conduct(math.inf).level(0.29, 0.25, 0.0) == 0.29


def test_a_tilted_table_is_stopped_after_half_a_second():
    conduct = Conduct(TILT)
    for k in range(5):
        conduct.tilts(0.1 * k, Sample(0.0, 0.2, 0.05))
    with pytest.raises(StopTrialError, match="now 150 mm") as stopped:
        conduct.tilts(0.5, Sample(0.0, 0.2, 0.05))
    assert stopped.value.stop is Stop.POLICY


def test_a_table_that_is_level_again_in_time_is_not_stopped():
    conduct = Conduct(TILT)
    for k in range(40):
        conduct.tilts(0.1 * k, Sample(0.0, 0.2, 0.2 if k % 5 == 4 else 0.05))
