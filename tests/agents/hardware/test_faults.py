"""What a fault ends in, and when: in simulated time, to the control period."""

import numpy as np
import pytest
from colift.agents.hardware.stops import HoldReason, Stop

pytestmark = pytest.mark.slow

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
        ("dropout@0", HoldReason.STALE, 0.2, Stop.CAPTURE_LOST, 1.0),
        ("latency@0:99:0.3", HoldReason.STALE, 0.2, Stop.CAPTURE_LOST, 1.2),
        ("nan@0", HoldReason.NOT_SEEN, 0.0, Stop.CAPTURE_UNUSABLE, 1.0),
        ("drift@0:99:0.1", HoldReason.DISAGREE, 0.3, Stop.CAPTURE_UNUSABLE, 1.3),
        ("jitter@0:99:2.0", HoldReason.STALE, 0.2, Stop.CAPTURE_LOST, 1.0),
        ("freeze@0", HoldReason.NOT_SEEN, 0.12, Stop.CAPTURE_UNUSABLE, 1.1),
        ("freeze@0:99:1", HoldReason.NOT_SEEN, 0.12, Stop.CAPTURE_UNUSABLE, 1.1),
        ("unit-change@0", HoldReason.JUMP, 0.0, Stop.CAPTURE_UNUSABLE, 1.0),
        ("future-stamps@0", HoldReason.STALE, 0.2, Stop.CAPTURE_LOST, 1.0),
        ("future-stamps@0:99:0.05", HoldReason.STALE, 0.2, Stop.CAPTURE_LOST, 1.0),
        ("nan-stamps@0", HoldReason.STALE, 0.2, Stop.CAPTURE_LOST, 1.0),
        ("slow@0", HoldReason.FEW, 0.85, Stop.CAPTURE_LOST, 1.8),
        ("past-stamps@0", HoldReason.STALE, 0.2, Stop.CAPTURE_LOST, 1.0),
        ("past-stamps@0:99:0.3", HoldReason.STALE, 0.3, Stop.CAPTURE_LOST, 1.2),
        ("loss@0:99:1", HoldReason.STALE, 0.2, Stop.CAPTURE_LOST, 1.0),
    ],
)
def test_motion_capture_that_stays_bad_holds_the_hands_and_then_stops_them(
    play, fault, hold, detected, stop, stopped
):
    trial = play("copy", faults={AT: fault})
    assert trial.log.stop is stop
    assert trial.held_since(hold) <= detected + REACTION
    assert trial.last_command() <= detected + REACTION
    assert stopped - 1e-9 <= trial.ended <= stopped + REACTION
    assert rests(trial)


class Rise:
    """Lifts its end by 8 mm a step, up to 64 mm."""

    def reset(self, seed):
        pass

    def act(self, observation):
        return np.array([0.008 if observation[3] < 0.06 else 0.0])


@pytest.mark.parametrize("value", [0.3, 0.5, 0.7, 1.2])
@pytest.mark.parametrize("late", [0.0, 0.04, 0.08])
def test_a_set_point_that_somebody_else_holds_is_noticed_whenever_it_comes(play, value, late):
    """The shoulder is at 0.57 rad when it comes, and on its way to 0.44 rad."""
    trial = play(Rise(), faults={6: f"foreign-setpoint@{late}:99:{value}"}, duration=3.0)
    assert trial.log.stop is Stop.MOTORS
    assert "something else commands the robot" in trial.log.reason
    # On the way of this client's own commands, it is seen once these have left it behind.
    assert trial.ended <= (0.7 if value == 0.5 else 0.1 + REACTION)


def test_ends_that_are_taken_for_each_other_hold_the_hands_and_then_stop_them(play):
    trial = play("hold", faults={25: "swap@0"})
    assert trial.held_since(HoldReason.JUMP) <= REACTION
    assert trial.held_since(HoldReason.DISAGREE) <= 0.1 + REACTION
    assert trial.log.stop is Stop.CAPTURE_UNUSABLE
    assert 1.0 <= trial.ended <= 1.0 + REACTION
    assert rests(trial)


@pytest.mark.parametrize(
    ("fault", "stop", "within"),
    [
        ("disconnect@0", Stop.ROBOT_LOST, 0.0),
        ("silence@0", Stop.ROBOT_LOST, 0.15),
        ("stream-end@0", Stop.CAPTURE_LOST, 0.0),
        ("motor-off@0", Stop.MOTORS, 0.0),
        ("foreign-setpoint@0:0.3", Stop.MOTORS, 0.0),
        ("hang@0", Stop.ROBOT_LOST, 0.15),
        (lambda lab: lab.button.press("the Enter key"), Stop.OPERATOR, 0.0),
    ],
)
def test_what_cannot_be_waited_for_stops_at_once(play, fault, stop, within):
    trial = play("copy", faults={AT: fault})
    assert trial.log.stop is stop
    assert trial.ended <= within + REACTION
    assert trial.last_command() <= 0.0
    if stop is Stop.ROBOT_LOST:
        # Nothing reaches the robot any more; it completes the last command and stays.
        trial.lab.wait_until(trial.lab.now() + 0.5)
        settled = trial.lab.set_points(trial.came + 0.12)
        assert len(settled) >= 40
        assert np.ptp(settled) == 0.0
    elif stop is not Stop.OPERATOR and not str(fault).startswith("foreign"):
        assert rests(trial)


@pytest.mark.parametrize(
    ("fault", "held"),
    [
        ("dropout@0:0.1", {""}),
        ("jitter@0:99:0.05", {""}),
        ("latency@0:99:0.08", {""}),
        ("future-stamps@0:99:0.02", {""}),
        ("slow@0:99:3", {""}),
        ("past-stamps@0:0.1", {""}),
        ("past-stamps@0:99:0.1", {""}),
        ("past-stamps@0:0.5", {"", HoldReason.STALE}),
        ("loss@0:99:0.4", {""}),
        ("duplicate@0:99:1", {""}),
        ("reorder@0:99:0.08", {""}),
        ("freeze@0:0.5", {"", HoldReason.NOT_SEEN}),
        ("dropout@0:0.5", {"", HoldReason.STALE}),
        ("nan@0:0.5", {"", HoldReason.NOT_SEEN}),
    ],
)
def test_what_passes_is_waited_for_and_the_lift_goes_on(play, fault, held):
    trial = play("copy", faults={AT: fault}, duration=6.0)
    assert trial.log.stop is None
    assert {step.hold for step in trial.log.steps} == held
    assert len(trial.log.steps) == 60
    assert trial.last_command() > 4.0


def test_a_stopped_arm_takes_no_command_any_more(play):
    trial = play("copy", faults={AT: "stream-end@0"})
    sent = len(trial.lab.sent)
    with pytest.raises(Exception, match="no more commands are accepted"):
        trial.arm.command(0.1, 0.1)
    assert len(trial.lab.sent) == sent


def test_bursts_that_each_pass_end_the_trial_together(play):
    trial = play("copy", faults=dict.fromkeys(range(10, 50, 10), "dropout@0:0.6"), duration=8.0)
    assert trial.log.stop is Stop.CAPTURE_LOST
    held = [step for step in trial.log.steps if step.hold]
    assert 10 <= len(held) <= 12
    assert "held for 1.0 s of the last 5 s" in trial.log.reason
    assert rests(trial)


class Always:
    """Wants the same change at each step, in turn up and down if it is to."""

    def __init__(self, change, turning):
        self.change, self.turning = change, turning

    def reset(self, seed):
        self.sign = 1

    def act(self, observation):
        self.sign = -self.sign if self.turning else 1
        return [self.sign * self.change]


@pytest.mark.parametrize(("change", "turning"), [(0.5, True), (0.04, True), (1e300, False)])
def test_a_policy_that_shakes_or_tilts_the_table_is_stopped_within_a_second(play, change, turning):
    trial = play(Always(change, turning), duration=5.0)
    assert trial.log.stop is Stop.POLICY
    assert len(trial.log.steps) <= 11
    ends = np.array([sample[1:] for sample in trial.log.samples])
    assert np.abs(ends[:, 0] - ends[:, 1]).max() < 0.16
    assert rests(trial)


@pytest.mark.parametrize("behaviour", ["smooth", "jerky", "pause", "changing_goal"])
@pytest.mark.parametrize("policy", ["blend", "anticipate", "proportional", "extrapolate"])
def test_a_policy_that_follows_the_person_is_not_stopped(play, policy, behaviour):
    trial = play(policy, behaviour=behaviour, duration=6.5)
    assert trial.log.stop is None
    assert not any(step.hold for step in trial.log.steps)
    assert max(step.astray for step in trial.log.steps) < 1e-9


def test_a_dry_run_is_not_stopped_for_the_tilt(play):
    trial = play("hold", duration=6.0, dry=True)
    assert max(abs(s.human_end - s.robot_end) for s in trial.log.samples) > 0.15
    assert trial.log.stop is None
    assert play("hold", duration=6.0).log.stop is Stop.POLICY
