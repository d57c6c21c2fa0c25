"""A machine that was away: what the loop does before it sends anything, in simulated time."""

import numpy as np
import pytest
from colift.agents.hardware.loop import LONGEST_GAP
from colift.agents.hardware.ports import RobotLostError
from colift.agents.hardware.stops import HoldReason, Stop

AT = 15
"""Step before which the machine is away: the table is on its way up."""


def away(seconds):
    """Return a fault: time passes without the loop."""
    return lambda lab: lab._pass(seconds)


class Slow:
    """Follows the person, and at one step takes its time."""

    def __init__(self, seconds):
        self.seconds, self.lab, self.steps = seconds, None, 0

    def reset(self, seed):
        pass

    def act(self, observation):
        self.steps += 1
        if self.steps == AT:
            self.lab._pass(self.seconds)
        return np.clip([observation[0] - observation[3]], -0.03, 0.03)


@pytest.mark.slow
@pytest.mark.parametrize("seconds", [0.6, 2.0, 100.0])
def test_a_gap_stops_the_trial_before_anything_is_sent(play, seconds):
    trial = play("copy", faults={AT: away(seconds)})
    assert trial.log.stop is Stop.CONTROLLER
    assert f"away for {seconds:.1f} s" in trial.log.reason
    (frozen,) = trial.lab.times("killAll")
    sent = [call for time, *call in trial.lab.sent if trial.came < time]
    assert sent[0][0] == "killAll"
    assert frozen == pytest.approx(trial.came + seconds, abs=0.02)
    assert trial.last_command() <= 0


@pytest.mark.parametrize(
    ("period", "seconds", "stop"),
    [(0.1, 0.45, None), (0.5, 0.9, None), (0.5, 1.1, Stop.CONTROLLER), (0.02, 0.45, None)],
)
def test_a_shorter_gap_is_a_hold(play, period, seconds, stop):
    at = round(1.5 / period)
    trial = play("copy", faults={at: away(seconds)}, period=period, latency=0.1)
    assert trial.log.stop is stop
    if stop is None:
        assert trial.log.late_steps == int((seconds - period) / period + 1e-6)


def test_skipped_periods_count_as_holds(play):
    faults = dict.fromkeys(range(10, 60, 4), away(0.35))
    trial = play("copy", faults=faults, duration=9.0)
    assert trial.log.stop is Stop.CONTROLLER
    assert HoldReason.SKIPPED.value in trial.log.reason
    assert "held for 1." in trial.log.reason
    # Each gap lets two periods and a half pass: the fourth is one too many.
    assert trial.log.late_steps == 8


def test_a_policy_that_slept_with_the_machine_moves_nothing(play):
    policy = Slow(LONGEST_GAP + 0.1)

    def meet(lab):
        policy.lab = lab

    trial = play(policy, faults={0: meet})
    assert trial.log.stop is Stop.CONTROLLER
    asleep = trial.lab.times("killAll")[0]
    assert trial.lab.times("setAngles")[-1] < asleep - LONGEST_GAP


def test_a_robot_that_answered_while_nobody_listened_is_not_lost(play):
    def deaf(lab):
        def calls(service, calls, *, within=0.15):
            lab._pass(0.7)
            raise RobotLostError("no answer within 0.15 s")

        lab.calls = calls

    trial = play("copy", faults={AT: deaf})
    assert trial.log.stop is Stop.CONTROLLER
    assert "no answer" not in trial.log.reason


class Late:
    """A robot whose set-points stand still for a while, and then go on."""

    def __init__(self, seconds):
        self.seconds = seconds

    def __call__(self, lab):
        motion = lab._laboratory._motion
        tick, end = motion.tick, lab.now() + self.seconds
        motion.tick = lambda: tick() if lab.now() > end else None


@pytest.mark.parametrize("at", [6, 15, 20, 25])
def test_a_late_command_is_not_said_to_be_somebody_elses(play, at):
    trial = play("copy", faults={at: Late(3.0)}, duration=4.0)
    assert trial.log.stop in (Stop.MOTORS, Stop.POLICY)
    assert "something else" not in trial.log.reason
    if trial.log.stop is Stop.MOTORS:
        assert "carried out late" in trial.log.reason


def test_a_late_robot_is_told_as_such(play):
    told = [play("copy", faults={at: Late(3.0)}, duration=4.0).log.reason for at in (12, 18)]
    assert any("carried out late" in reason for reason in told), told
