"""A watchdog on another machine: over libqi, with claims of clients that die."""

import time
from contextlib import closing

import pytest
from colift.agents.hardware.claim import BEAT, NOBODY, STALE, RobotClaim, holder
from colift.agents.hardware.nao.naoqi import NaoqiArm
from colift.agents.hardware.watchdog import watch

from .conftest import PatientSession

pytestmark = pytest.mark.slow


class Until:
    """Ends a watchdog when something is so, or after a while; until then, it lets time pass."""

    def __init__(self, condition, seconds=60.0):
        self.condition, self.end = condition, time.monotonic() + seconds

    def __call__(self, seconds):
        time.sleep(seconds)
        return self.condition() or time.monotonic() > self.end


def test_arms_whose_client_is_gone_are_released(laboratory):
    with (
        closing(PatientSession(laboratory.url)) as session,
        closing(PatientSession(laboratory.url)) as own,
    ):
        claim = RobotClaim(session)
        claim._write(claim._own)
        beats = iter(range(8))
        before = laboratory.mark()

        def over():
            # It lives for a while, and is watched meanwhile.
            if next(beats, None) is not None:
                assert claim.beat() == ""
            return "rest" in laboratory.lines[before:]

        begin = time.monotonic()
        watch(NaoqiArm(own), Until(over))
        assert time.monotonic() - begin > 8 * BEAT / 2 + STALE
        lines = laboratory.happened_since(before)
        assert lines.index("killAll") < lines.index("stiffness 0 2") < lines.index("rest")
        assert holder(session) == NOBODY
        # Its holder notices, should it come back.
        assert claim.beat() == "nobody"


def test_a_claim_that_was_dead_before_is_left_alone(laboratory):
    with (
        closing(PatientSession(laboratory.url)) as session,
        closing(PatientSession(laboratory.url)) as own,
    ):
        dead = RobotClaim(session)
        dead._write(dead._own)
        before = laboratory.mark()
        watch(NaoqiArm(own), Until(lambda: False, seconds=STALE + 3))
        assert laboratory.happened_since(before) == []
        assert holder(session).token == dead.token
        session.call("ALMemory", "insertData", "Colift/Commander", list(NOBODY))
