"""Faults over the real protocols: another process is the robot and the motion capture.

How long each reaction takes is asserted in simulated time (test_faults.py). Here a machine that
has other work delays robot, motion capture and loop alike: a fault begins when the emulator says
so, and stays until the trial has ended; the limits are those of the trial's own log.
"""

import time
from contextlib import closing, contextmanager, suppress
from itertools import pairwise

import numpy as np
import pytest
from colift.agents.hardware.clocks import MonotonicClock
from colift.agents.hardware.conduct import LARGEST_REVERSAL, TILT_TIME, reversed_path
from colift.agents.hardware.decisions import Timed
from colift.agents.hardware.holds import LIMIT
from colift.agents.hardware.loop import LoopSettings, run_trial
from colift.agents.hardware.lsl import Layout, LslCapture
from colift.agents.hardware.nao.naoqi import NAMES, NaoqiArm
from colift.agents.hardware.nao.session import NaoqiSession
from colift.agents.hardware.plausibility import STALE
from colift.agents.hardware.ports import RobotLostError
from colift.agents.hardware.safety import ASTRAY
from colift.agents.hardware.setup import measure_rest
from colift.agents.hardware.stops import HoldReason, Stop
from colift.agents.hardware.trial_end import AfterDuration

from .conftest import PatientSession

pytestmark = pytest.mark.slow

AT = 6
"""Step before which the fault comes."""

REACTION = 0.2
"""How long after its limit a fault may take to hold the hands [s]."""

LATE = {HoldReason.POLICY_LATE, HoldReason.POLICY_BUSY}
OLD = {HoldReason.STALE, HoldReason.FEW}
AGEING = (
    "dropout", "slow", "future", "nan-stamps", "latency", "jitter", "stream-end", "past", "loss",
)  # fmt: skip
LOSING = ("silence", "hang")


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
    """A trial's end that lets faults come before a step, and waits until the first is there."""

    def __init__(self, duration, laboratory, session, fault):
        super().__init__(duration=duration)
        self.laboratory, self.session = laboratory, session
        self.fault, self.came = fault, None

    def over(self, log):
        if len(log.steps) == AT and self.fault and self.came is None:
            line = "fault " + self.fault.partition("@")[0]
            seen = self.laboratory.lines.count(line)
            # A connection that closes may take the answer with it.
            with suppress(RobotLostError):
                for text in self.fault.split():
                    self.session.call("ColiftFaults", "request", text)
            self.laboratory.await_line(line, after=seen)
            self.came = time.monotonic()
        return super().over(log)


@contextmanager
def captured(laboratory):
    """Receive a laboratory's frames, with the table at rest as their origin."""
    with closing(LslCapture(laboratory.stream, Layout())) as capture:
        rest = measure_rest(capture, MonotonicClock())
        capture.set_rest(rest.human_end, rest.robot_end)
        yield capture


@pytest.fixture(scope="module")
def capture(laboratory):
    with captured(laboratory) as made:
        yield made


@pytest.fixture
def lift(laboratory, capture):
    """Play a short trial with a fault; the hands begin at rest, and the person stays there."""

    def play(fault, duration, policy=Rise, tries=5):
        for _ in range(tries):
            with suppress(RobotLostError):
                log, came = once(fault, duration, policy)
                if not disturbed(fault, log, came):
                    break
        return log, came

    def once(fault, duration, policy):
        session = NaoqiSession(laboratory.url)
        try:
            arm = NaoqiArm(session)
            arm.take_hold()
            time.sleep(0.3)
            arm.weight_offset = -arm.state().height
            end = Faulty(duration, laboratory, session, fault)
            decider = Timed(policy())
            capture.drain()
            log = run_trial(
                arm, capture, decider, MonotonicClock(), settings=LoopSettings(), end=end
            )
            decider.close()
            return log, end.came
        finally:
            session.close()
            well(laboratory)

    return play


def disturbed(fault, log, came):
    """Return whether the trial tells of the machine's other work, and not of the fault."""
    holds = {step.hold for step in log.steps}
    return (
        bool(fault and came is None)
        or (log.stop is Stop.ROBOT_LOST and not fault.startswith((*LOSING, "disconnect")))
        or bool(holds & LATE)
        or bool(holds & OLD and not fault.startswith(AGEING))
    )


def well(laboratory):
    """End the faults, and wait until the robot answers and late frames have come."""
    session = PatientSession(laboratory.url)
    session.call("ColiftFaults", "clear", within=3.0)
    session.call("ALMotion", "getAngles", NAMES, False, within=3.0)
    session.close()
    time.sleep(0.5)


def held(steps):
    """Return how long the hands were held until the last of some steps [s]."""
    return sum(after.time - before.time for before, after in pairwise(steps) if before.hold)


def stopped_by_the_limit(log):
    """Return whether no earlier held step was beyond the limit of holds."""
    earlier = [k for k, step in enumerate(log.steps[:-1]) if step.hold]
    return held(log.steps[: earlier[-1] + 1]) <= LIMIT - log.period / 2 + 1e-9


def since(log, came):
    """Return the steps that began when the fault was there."""
    return [step for step in log.steps if step.time > came]


def still(laboratory, seconds=0.5):
    """Return whether the set-points of the hands, asked for by somebody else, do not move."""
    session = PatientSession(laboratory.url)
    seen = []
    end = time.monotonic() + seconds
    while time.monotonic() < end or len(seen) <= 5:
        seen.append(session.call("ALMotion", "getAngles", NAMES, False, within=3.0))
    session.close()
    return all(angles == seen[0] for angles in seen)


def comes_to_rest(laboratory, seconds=30):
    """Return whether the set-points stop moving."""
    end = time.monotonic() + seconds
    while not still(laboratory):
        if time.monotonic() > end:
            return False
    return True


@pytest.mark.parametrize(
    ("fault", "detected", "stop"),
    [
        ("dropout@0", 0.2, Stop.CAPTURE_LOST),
        ("latency@0:99:0.4", 0.2, Stop.CAPTURE_LOST),
        ("nan@0", 0.05, Stop.CAPTURE_UNUSABLE),
        ("freeze@0", 0.15, Stop.CAPTURE_UNUSABLE),
        ("unit-change@0", 0.05, Stop.CAPTURE_UNUSABLE),
        ("future-stamps@0", 0.2, Stop.CAPTURE_LOST),
        ("nan-stamps@0", 0.2, Stop.CAPTURE_LOST),
        ("slow@0", 0.95, Stop.CAPTURE_LOST),
        ("past-stamps@0", 0.2, Stop.CAPTURE_LOST),
        ("loss@0:99:0.95", 0.95, Stop.CAPTURE_LOST),
    ],
)
def test_motion_capture_that_stays_bad_holds_the_hands_and_then_stops_them(
    laboratory, lift, fault, detected, stop
):
    log, came = lift(fault, 15.0)
    assert (log.stop, log.reason != "") == (stop, True)
    late = since(log, came + detected + REACTION)
    assert late
    assert all(step.hold and step.command == step.hand_command for step in late)
    assert stopped_by_the_limit(log)
    assert still(laboratory)


def test_bursts_that_each_pass_end_the_trial_together(laboratory, lift):
    bursts = " ".join(f"dropout@{start}:0.6" for start in range(12))
    log, came = lift(bursts, 15.0)
    assert log.stop is Stop.CAPTURE_LOST
    assert "s of the last 5 s" in log.reason
    first = next(k for k, step in enumerate(log.steps) if step.time > came and step.hold)
    assert any(not step.hold for step in log.steps[first:])
    assert stopped_by_the_limit(log)
    assert still(laboratory)


def test_a_policy_that_shakes_the_table_is_stopped(laboratory, lift):
    log, _ = lift("", 15.0, Shake)
    assert log.stop is Stop.POLICY
    assert "shakes the table" in log.reason
    reversals = [
        reversed_path([s.command for s in log.steps[: k + 1] if s.time >= step.time - 1.0])
        for k, step in enumerate(log.steps)
    ]
    assert max(reversals[:-1]) <= LARGEST_REVERSAL < reversals[-1]
    assert still(laboratory)


def test_a_policy_that_tilts_the_table_is_stopped(laboratory, lift):
    log, _ = lift("", 15.0, Raise)
    assert log.stop is Stop.POLICY
    assert "is tilted" in log.reason
    # The hands of the person give way, by a quarter of what the table rises.
    assert max(step.command for step in log.steps) <= 0.19
    judged = [step for step in log.steps if not step.hold]
    clipped = next(step for step in judged if step.command < step.hand_command + 0.03)
    assert judged[-2].time - clipped.time <= TILT_TIME
    assert still(laboratory)


@pytest.mark.parametrize(
    "fault",
    [
        "jitter@0:0.8:0.08",
        "dropout@0:0.1",
        "loss@0:0.8:0.3",
        "duplicate@0:0.8:1",
        "reorder@0:0.8:0.05",
        "past-stamps@0:0.1",
    ],
)
def test_what_can_be_lived_with_is(lift, fault):
    log, came = lift(fault, 1.6)
    assert log.stop is None
    after = since(log, came)
    assert any(not step.hold for step in after)
    fresh = [step for step in after if step.sensing_age <= STALE]
    assert not any(step.hold for step in fresh if step.hold not in LATE)


def test_motors_without_stiffness_stop_the_trial(laboratory, lift):
    log, came = lift("motor-off@0", 15.0)
    assert log.stop is Stop.MOTORS
    assert "stiffness 0.00" in log.reason
    (last,) = since(log, came)
    assert last.command == last.hand_command
    assert still(laboratory)


def test_a_set_point_that_somebody_else_gave_stops_the_trial(laboratory, lift):
    """Away from the way of the hands: 0.77 rad at rest, and less further up."""
    log, came = lift("foreign-setpoint@0:99:1.2", 15.0)
    assert log.stop is Stop.MOTORS
    assert "something else commands the robot" in log.reason
    *before, last = log.steps
    assert max(step.astray for step in before if step.time < came) < 1e-6
    assert max(step.astray for step in before) <= ASTRAY < last.astray
    assert last.command == last.hand_command
    assert comes_to_rest(laboratory)


@pytest.mark.parametrize("fault", LOSING)
def test_a_robot_that_does_not_answer_stops_the_trial(laboratory, lift, fault):
    """It answers nothing at all, or nothing about its joints."""
    log, came = lift(f"{fault}@0", 15.0)
    assert log.stop is Stop.ROBOT_LOST
    assert "no answer within 0.15 s" in log.reason
    # The emulator says it just before it does it.
    assert len(since(log, came)) <= 1
    assert still(laboratory)


# The stream and the connection end for good, so that these laboratories are shared with no test.


@pytest.fixture
def ending(emulate):
    """Play a trial with a fault that does not end, and return the laboratory, too."""

    def play(fault, tries=3):
        for _ in range(tries):
            laboratory = emulate()
            session = NaoqiSession(laboratory.url)
            end = Faulty(15.0, laboratory, session, fault)
            with captured(laboratory) as capture, closing(Timed(Rise())) as decider:
                clock, settings = MonotonicClock(), LoopSettings()
                arm = NaoqiArm(session)
                log = run_trial(arm, capture, decider, clock, settings=settings, end=end)
            session.close()
            if not disturbed(fault, log, end.came):
                break
        return log, end.came, laboratory

    return play


def test_a_stream_that_ends_stops_the_trial(ending):
    log, came, laboratory = ending("stream-end@0")
    assert log.stop is Stop.CAPTURE_LOST
    assert all(step.hold for step in since(log, came + STALE + REACTION))
    assert not log.steps[-2].hold or stopped_by_the_limit(log)
    assert still(laboratory)


def test_a_robot_whose_connection_closes_stops_the_trial(ending):
    log, came, laboratory = ending("disconnect@0")
    assert log.stop is Stop.ROBOT_LOST
    assert len(since(log, came)) <= 1
    # Nothing reaches the robot any more.
    after = laboratory.lines[laboratory.lines.index("fault disconnect") :]
    assert not any(line.startswith("motion") for line in after)
