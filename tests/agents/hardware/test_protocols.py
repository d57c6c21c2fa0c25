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
from colift.agents.hardware.naoqi import NAMES, NaoqiArm
from colift.agents.hardware.naoqi_session import NaoqiSession
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


class Faulty(AfterDuration):
    """A trial's end that lets a fault come before a step."""

    def __init__(self, duration, session, fault):
        super().__init__(duration=duration)
        self.session, self.fault, self.came = session, fault, None

    def over(self, record):
        if len(record.steps) == AT and self.came is None:
            self.came = time.monotonic()
            # A connection that closes may take the answer with it.
            with suppress(RobotLostError):
                self.came = self.session.call("ColiftFaults", "request", self.fault)
        return super().over(record)


@pytest.fixture(scope="module")
def laboratory(emulate):
    return emulate()


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

    def play(fault, duration):
        session = NaoqiSession(laboratory.url)
        sessions.append(session)
        arm = NaoqiArm(session)
        arm.take_hold()
        time.sleep(0.3)
        arm.weight_offset = -arm.state().height
        end = Faulty(duration, session, fault)
        decider = Timed(Rise())
        record = run_trial(
            arm, capture, decider, MonotonicClock(), settings=LoopSettings(), end=end
        )
        finished = time.monotonic()
        decider.close()
        steps = record.steps
        # What the machine, not the loop, is late by.
        slip = max(step.time - step.deadline for step in steps) + 0.1 * record.late_steps
        slip += steps[-1].policy_time + steps[-1].state_time
        return record, end.came, finished - end.came - slip

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
        ("swap@0:1.7", 0.05, Stop.CAPTURE_UNUSABLE, 1.05),
        ("drift@0:1.8:0.15", 0.3, Stop.CAPTURE_UNUSABLE, 1.3),
    ],
)
def test_motion_capture_that_stays_bad_holds_the_hands_and_then_stops_them(
    laboratory, lift, fault, detected, stop, stopped
):
    record, came, ended = lift(fault, 5.0)
    assert (record.stop, record.reason != "") == (stop, True)
    late = [step for step in record.steps if step.time - came > detected + REACTION]
    assert len(late) >= 3
    assert all(step.hold and step.command == step.hand_command for step in late)
    assert ended <= stopped + REACTION
    assert still(laboratory)
    time.sleep(max(0.0, came + 2.0 - time.monotonic()))


@pytest.mark.parametrize("fault", ["jitter@0:0.8:0.08", "dropout@0:0.1"])
def test_what_can_be_lived_with_is(lift, fault):
    record, came, _ = lift(fault, 1.6)
    assert record.stop is None
    after = [step for step in record.steps if step.time > came]
    assert sum(not step.hold for step in after) > len(after) / 2


def test_motors_without_stiffness_stop_the_trial(laboratory, lift):
    record, _, ended = lift("motor-off@0:1.0", 3.0)
    assert record.stop is Stop.MOTORS
    assert "stiffness 0.00" in record.reason
    assert ended <= REACTION
    assert still(laboratory)
    time.sleep(1.0)


def test_a_robot_that_does_not_answer_stops_the_trial(laboratory, lift):
    record, _, ended = lift("silence@0:1.0", 3.0)
    assert record.stop is Stop.ROBOT_LOST
    assert ended <= 0.15 + REACTION
    assert still(laboratory)


# The last two are for good: the emulator's stream and connection end.


def test_a_stream_that_ends_stops_the_trial(laboratory, lift):
    record, _, ended = lift("stream-end@0", 4.0)
    assert record.stop is Stop.CAPTURE_LOST
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
    record = run_trial(
        NaoqiArm(session), capture, decider, MonotonicClock(), settings=LoopSettings(), end=end
    )
    decider.close()
    capture.close()
    assert record.stop is Stop.ROBOT_LOST
    assert record.steps[-1].time < end.came + 0.15 + REACTION
    # Nothing reaches the robot any more.
    laboratory.await_line("fault disconnect")
    after = laboratory.lines[laboratory.lines.index("fault disconnect") :]
    assert not any(line.startswith("motion") for line in after)
