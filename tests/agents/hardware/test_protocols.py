"""Faults over the real protocols: another process is the robot and the motion capture.

What depends on the machine's load is measured along: how late the loop began its steps.
"""

import time
from contextlib import suppress

import numpy as np
import pytest
from colift.agents.hardware.clocks import MonotonicClock
from colift.agents.hardware.decisions import Timed
from colift.agents.hardware.loop import LoopSettings, run_trial
from colift.agents.hardware.lsl import Layout, LslCapture
from colift.agents.hardware.nao.naoqi import NAMES, NaoqiArm
from colift.agents.hardware.nao.session import NaoqiSession
from colift.agents.hardware.ports import RobotLostError
from colift.agents.hardware.setup import measure_rest
from colift.agents.hardware.stops import Stop
from colift.agents.hardware.trial_end import AfterDuration

AT = 6
"""Step before which the fault comes."""

REACTION = 0.2
"""How long after its limit a fault may take to be acted on [s]."""


class Rise:
    """Lifts its end by 8 mm a step, up to 64 mm."""

    def reset(self, seed):
        pass

    def act(self, observation):
        return np.array([0.008 if observation[3] < 0.06 else 0.0])


class Shake:
    """Moves its end up and down by as much as it may, in turn."""

    def reset(self, seed):
        pass

    def act(self, observation):
        return np.array([0.5 if observation[3] < 0.01 else -0.5])


class Raise:
    """Moves its end up, whatever the person does."""

    def reset(self, seed):
        pass

    def act(self, observation):
        return np.array([1e300])


class Faulty(AfterDuration):
    """A trial's end that lets faults come before a step."""

    def __init__(self, duration, session, fault):
        super().__init__(duration=duration)
        self.session, self.fault, self.came = session, fault, None

    def over(self, log):
        if len(log.steps) == AT and self.came is None:
            self.came = time.monotonic()
            # A connection that closes may take the answer with it.
            with suppress(RobotLostError):
                for text in self.fault.split():
                    self.came = self.session.call("ColiftFaults", "request", text)
        return super().over(log)


@pytest.fixture(scope="module")
def capture(laboratory):
    made = LslCapture(laboratory.stream, Layout())
    rest = measure_rest(made, MonotonicClock())
    made.set_rest(rest.human_end, rest.robot_end)
    yield made
    made.close()


@pytest.fixture
def lift(laboratory, capture):
    """Play a short trial with a fault; the hands begin at rest, and the person stays there."""
    sessions = []

    def play(fault, duration, policy=Rise, tries=3):
        # Where other processes keep the emulator from answering in time, the robot counts as lost.
        lost = fault.startswith(("silence", "hang", "stream-end"))
        for _ in range(tries):
            with suppress(RobotLostError):
                played = once(fault, duration, policy)
                if lost or played[0].stop is not Stop.ROBOT_LOST:
                    break
            time.sleep(4.0)
        return played

    def once(fault, duration, policy):
        session = NaoqiSession(laboratory.url)
        sessions.append(session)
        arm = NaoqiArm(session)
        arm.take_hold()
        time.sleep(0.3)
        arm.weight_offset = -arm.state().height
        end = Faulty(duration, session, fault)
        decider = Timed(policy())
        log = run_trial(arm, capture, decider, MonotonicClock(), settings=LoopSettings(), end=end)
        finished = time.monotonic()
        decider.close()
        steps = log.steps
        # What the machine, not the loop, is late by.
        slip = max(step.time - step.deadline for step in steps) + 0.1 * log.late_steps
        slip += steps[-1].policy_time + steps[-1].state_time
        return log, end.came, finished - end.came - slip

    yield play
    for session in sessions:
        session.close()


def still(laboratory, seconds=0.5):
    """Return whether the set-points of the hands, asked for by somebody else, do not move."""
    session = NaoqiSession(laboratory.url)
    seen = []
    end = time.monotonic() + seconds
    while time.monotonic() < end:
        seen.append(session.call("ALMotion", "getAngles", NAMES, False, within=3.0))
    session.close()
    return len(seen) > 5 and all(angles == seen[0] for angles in seen)


@pytest.mark.parametrize(
    ("fault", "detected", "stop", "stopped"),
    [
        ("dropout@0:1.5", 0.2, Stop.CAPTURE_LOST, 1.0),
        ("latency@0:1.6:0.4", 0.2, Stop.CAPTURE_LOST, 1.2),
        ("nan@0:1.5", 0.05, Stop.CAPTURE_UNUSABLE, 1.05),
        ("freeze@0:1.6", 0.15, Stop.CAPTURE_UNUSABLE, 1.15),
        ("unit-change@0:1.5", 0.05, Stop.CAPTURE_UNUSABLE, 1.05),
        ("future-stamps@0:1.5", 0.2, Stop.CAPTURE_LOST, 1.0),
        ("nan-stamps@0:1.5", 0.2, Stop.CAPTURE_LOST, 1.0),
        ("slow@0:2.5", 0.95, Stop.CAPTURE_LOST, 1.95),
    ],
)
def test_motion_capture_that_stays_bad_holds_the_hands_and_then_stops_them(
    laboratory, lift, fault, detected, stop, stopped
):
    log, came, ended = lift(fault, 5.0)
    assert (log.stop, log.reason != "") == (stop, True)
    late = [step for step in log.steps if step.time - came > detected + REACTION]
    assert len(late) >= 3
    assert all(step.hold and step.command == step.hand_command for step in late)
    assert ended <= stopped + REACTION
    assert still(laboratory)
    lasts = sum(map(float, fault.partition("@")[2].split(":")))
    time.sleep(max(0.0, came + lasts + 0.4 - time.monotonic()))


def test_bursts_that_each_pass_end_the_trial_together(laboratory, lift):
    bursts = " ".join(f"dropout@{start}:0.6" for start in range(4))
    log, came, ended = lift(bursts, 6.0)
    assert log.stop is Stop.CAPTURE_LOST
    assert "held for 1.0 s of the last 5 s" in log.reason
    after = [step for step in log.steps if step.time > came]
    assert any(not step.hold for step in after[8:])
    assert 1.0 < ended <= 2.6 + REACTION
    assert still(laboratory)
    time.sleep(max(0.0, came + 3.8 - time.monotonic()))


@pytest.mark.parametrize(
    ("policy", "told", "within"), [(Shake, "shakes the table", 1.0), (Raise, "is tilted", 1.0)]
)
def test_a_policy_that_shakes_or_tilts_the_table_is_stopped(laboratory, lift, policy, told, within):
    log, _, _ = lift("jitter@0:0.1:0", 5.0, policy)
    assert log.stop is Stop.POLICY
    assert told in log.reason
    late = log.late_steps * log.period
    assert log.steps[-1].deadline - log.start <= within + REACTION + late
    # The hands of the person give way, by a quarter of what the table rises.
    assert max(step.command for step in log.steps) <= 0.19
    assert still(laboratory)


@pytest.mark.parametrize("fault", ["jitter@0:0.8:0.08", "dropout@0:0.1"])
def test_what_can_be_lived_with_is(lift, fault):
    log, came, _ = lift(fault, 1.6)
    assert log.stop is None
    after = [step for step in log.steps if step.time > came]
    assert sum(not step.hold for step in after) > len(after) / 2


def test_motors_without_stiffness_stop_the_trial(laboratory, lift):
    log, _, ended = lift("motor-off@0:1.0", 3.0)
    assert log.stop is Stop.MOTORS
    assert "stiffness 0.00" in log.reason
    assert ended <= REACTION
    assert still(laboratory)
    time.sleep(1.0)


def test_a_set_point_that_somebody_else_gave_stops_the_trial(laboratory, lift):
    log, came, ended = lift("foreign-setpoint@0:0.6", 3.0)
    assert log.stop is Stop.MOTORS
    assert "something else commands the robot" in log.reason
    assert ended <= REACTION
    assert max(step.astray for step in log.steps if step.time < came) < 1e-6
    time.sleep(0.6)
    assert still(laboratory)


def test_a_robot_that_hangs_stops_the_trial(laboratory, lift):
    log, came, ended = lift("hang@0:1.0", 3.0)
    assert log.stop is Stop.ROBOT_LOST
    assert "no answer within 0.15 s" in log.reason
    # The last call, which is to freeze the arms, is not answered either.
    assert ended <= 0.15 + 0.15 + REACTION
    time.sleep(max(0.0, came + 1.2 - time.monotonic()))
    assert still(laboratory)


def test_a_robot_that_does_not_answer_stops_the_trial(laboratory, lift):
    log, came, ended = lift("silence@0:1.0", 3.0)
    assert log.stop is Stop.ROBOT_LOST
    assert ended <= 0.15 + REACTION
    time.sleep(max(0.0, came + 1.2 - time.monotonic()))
    assert still(laboratory)


# The last two are for good: the emulator's stream and connection end.


def test_a_stream_that_ends_stops_the_trial(laboratory, lift):
    log, _, ended = lift("stream-end@0", 4.0)
    assert log.stop is Stop.CAPTURE_LOST
    assert ended <= 1.0 + REACTION
    assert still(laboratory)


def test_a_robot_whose_connection_closes_stops_the_trial(emulate):
    laboratory = emulate()
    session = NaoqiSession(laboratory.url)
    capture = LslCapture(laboratory.stream, Layout())
    rest = measure_rest(capture, MonotonicClock())
    capture.set_rest(rest.human_end, rest.robot_end)
    end = Faulty(4.0, session, "disconnect@0")
    decider = Timed(Rise())
    log = run_trial(
        NaoqiArm(session), capture, decider, MonotonicClock(), settings=LoopSettings(), end=end
    )
    decider.close()
    capture.close()
    assert log.stop is Stop.ROBOT_LOST
    assert log.steps[-1].time < end.came + 0.15 + REACTION
    # Nothing reaches the robot any more.
    laboratory.await_line("fault disconnect")
    after = laboratory.lines[laboratory.lines.index("fault disconnect") :]
    assert not any(line.startswith("motion") for line in after)
