"""One who commands at a time, over libqi."""

import time

import pytest
from colift.agents.hardware.claim import KEY, NOBODY, STALE, RobotClaim, claimed, holder
from colift.agents.hardware.clocks import MonotonicClock
from colift.agents.hardware.nao.naoqi import NaoqiArm
from colift.agents.hardware.operator import StopButton
from colift.agents.hardware.ports import RobotTakenError
from colift.agents.hardware.stops import StopTrialError
from colift.base.errors import InputError

from .conftest import PatientSession


@pytest.fixture
def connect(laboratory):
    """Open sessions with the robot."""
    sessions = []

    def made():
        sessions.append(PatientSession(laboratory.url))
        return sessions[-1]

    yield made
    for session in sessions:
        session.close()


@pytest.mark.slow
def test_a_second_one_is_refused_for_as_long_as_the_first_lives(connect):
    clock, session = MonotonicClock(), connect()
    with claimed(NaoqiArm(connect()), clock):
        first = holder(session)
        begin = time.monotonic()
        with pytest.raises(InputError, match="only one client at a time"):
            RobotClaim(session).take(clock)
        assert time.monotonic() - begin < STALE
        time.sleep(STALE)
        now = holder(session)
        assert now.token == first.token
        assert now.beat > first.beat + 1
    assert holder(session) == NOBODY
    RobotClaim(session).take(clock)


@pytest.mark.slow
def test_a_claim_without_a_heartbeat_is_taken_over_and_its_owner_stops(connect, laboratory):
    clock, old = MonotonicClock(), connect()
    arm = NaoqiArm(old)
    dead = RobotClaim(old)
    dead._write(dead._own)
    with claimed(arm, clock):
        assert arm.state().stiffness == 1.0
        # Somebody who does not look takes it: the heartbeat tells, and nothing is sent any more.
        RobotClaim(connect())._write(NOBODY._replace(name="another", token="another"))
        end = time.monotonic() + 60
        while not arm.taken and time.monotonic() < end:
            time.sleep(0.05)
        with pytest.raises(RobotTakenError, match="commanded by another"):
            arm.state()
        with pytest.raises(RobotTakenError, match="commanded by another"):
            arm.command(0.1, 0.1)
        before = laboratory.mark()
        arm.stop()
    assert "killAll" not in laboratory.happened_since(before)
    # A claim that is not one's own is not given up.
    assert holder(old).name == "another"


def test_a_stop_while_it_is_claimed_leaves_no_claim(connect):
    session, button = connect(), StopButton()
    session.call("ALMemory", "insertData", KEY, list(NOBODY))
    button.press("SIGINT")
    with pytest.raises(StopTrialError), claimed(NaoqiArm(connect()), MonotonicClock(button)):
        pytest.fail("it is claimed")
    assert holder(session) == NOBODY


def test_two_who_claim_at_once_are_one(connect):
    first, second = RobotClaim(connect()), RobotClaim(connect())
    session = connect()
    session.call("ALMemory", "insertData", KEY, list(NOBODY))

    class Interrupted(MonotonicClock):
        """Lets the second one write while the first one waits for its claim to settle."""

        def wait_until(self, when):
            second._write(second._own)
            return super().wait_until(when)

    with pytest.raises(InputError, match="only one client at a time"):
        first.take(Interrupted())
    assert second.beat() == ""


@pytest.mark.slow
def test_a_claim_that_cannot_be_read_is_waited_for_and_taken_over(connect):
    session = connect()
    session.call("ALMemory", "insertData", KEY, "mine!")
    assert holder(session).name == "a claim that cannot be read"
    begin = time.monotonic()
    RobotClaim(session).take(MonotonicClock())
    assert time.monotonic() - begin >= STALE
