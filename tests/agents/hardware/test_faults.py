"""What a fault ends in, and when: in simulated time, to the control period."""

import numpy as np
import pytest
from colift.agents.hardware.stops import Hold, Stop

AT = 15
"""Step before which the fault comes: the table is on its way up."""

REACTION = 0.2
"""How long after its limit a fault may take to be acted on [s]."""


def rests(trial):
    """Return whether the hands' set-points stay where they were when the arms were frozen."""
    frozen = trial.lab.times("killAll")[0]
    trial.lab.wait_until(trial.lab.now() + 1.0)
    return len(trial.lab.set_points(frozen)) >= 100 and np.ptp(trial.lab.set_points(frozen)) == 0.0


@pytest.mark.parametrize(
    ("fault", "hold", "detected", "stop", "stopped"),
    [
        ("dropout@0", Hold.STALE, 0.2, Stop.CAPTURE_LOST, 1.0),
        ("latency@0:99:0.3", Hold.STALE, 0.2, Stop.CAPTURE_LOST, 1.2),
        ("nan@0", Hold.NOT_SEEN, 0.0, Stop.CAPTURE_UNUSABLE, 1.0),
        ("drift@0:99:0.1", Hold.DISAGREE, 0.3, Stop.CAPTURE_UNUSABLE, 1.3),
        ("jitter@0:99:2.0", Hold.STALE, 0.2, Stop.CAPTURE_LOST, 1.0),
    ],
)
def test_motion_capture_that_stays_bad_holds_the_hands_and_then_stops_them(
    play, fault, hold, detected, stop, stopped
):
    trial = play("copy", faults={AT: fault})
    assert trial.record.stop is stop
    assert trial.held_since(hold) <= detected + REACTION
    assert trial.last_command() <= detected + REACTION
    assert stopped - 1e-9 <= trial.ended <= stopped + REACTION
    assert rests(trial)


def test_ends_that_are_taken_for_each_other_hold_the_hands_and_then_stop_them(play):
    trial = play("hold", faults={25: "swap@0"})
    assert trial.held_since(Hold.JUMP) <= REACTION
    assert trial.held_since(Hold.DISAGREE) <= 0.1 + REACTION
    assert trial.record.stop is Stop.CAPTURE_UNUSABLE
    assert 1.0 <= trial.ended <= 1.0 + REACTION
    assert rests(trial)


@pytest.mark.parametrize(
    ("fault", "stop", "within"),
    [
        ("disconnect@0", Stop.ROBOT_LOST, 0.0),
        ("silence@0", Stop.ROBOT_LOST, 0.15),
        ("stream-end@0", Stop.CAPTURE_LOST, 0.0),
        ("motor-off@0", Stop.MOTORS, 0.0),
        (lambda lab: lab.button.press("the Enter key"), Stop.OPERATOR, 0.0),
    ],
)
def test_what_cannot_be_waited_for_stops_at_once(play, fault, stop, within):
    trial = play("copy", faults={AT: fault})
    assert trial.record.stop is stop
    assert trial.ended <= within + REACTION
    assert trial.last_command() <= 0.0
    if stop is Stop.ROBOT_LOST:
        # Nothing reaches the robot any more; it completes the last command and stays.
        trial.lab.wait_until(trial.lab.now() + 0.5)
        settled = trial.lab.set_points(trial.came + 0.12)
        assert len(settled) >= 40
        assert np.ptp(settled) == 0.0
    elif stop is not Stop.OPERATOR:
        assert rests(trial)


@pytest.mark.parametrize(
    ("fault", "held"),
    [
        ("dropout@0:0.1", {""}),
        ("jitter@0:99:0.05", {""}),
        ("latency@0:99:0.08", {""}),
        ("dropout@0:0.5", {"", Hold.STALE}),
        ("nan@0:0.5", {"", Hold.NOT_SEEN}),
    ],
)
def test_what_passes_is_waited_for_and_the_lift_goes_on(play, fault, held):
    trial = play("copy", faults={AT: fault}, duration=6.0)
    assert trial.record.stop is None
    assert {step.hold for step in trial.record.steps} == held
    assert len(trial.record.steps) == 60
    assert trial.last_command() > 4.0


def test_a_stopped_arm_takes_no_command_any_more(play):
    trial = play("copy", faults={AT: "stream-end@0"})
    sent = len(trial.lab.sent)
    with pytest.raises(Exception, match="no command is taken any more"):
        trial.arm.command(0.1, 0.1)
    assert len(trial.lab.sent) == sent
