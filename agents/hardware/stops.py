"""Reasons for holding the hands in a period, and for stopping a trial."""

from collections.abc import Iterator
from contextlib import contextmanager
from enum import IntEnum, StrEnum

from colift.agents.hardware.ports import CaptureLostError, RobotLostError, RobotTakenError


class HoldReason(StrEnum):
    """Reason for a period without a new command; the hands complete the last one and stay."""

    STALE = "stale motion capture"
    FEW = "too few motion-capture frames"
    NOT_SEEN = "a table end was not seen"
    JUMP = "a table end jumped"
    DISAGREE = "motion capture and encoders disagree"
    POLICY_FAILED = "the policy failed"
    POLICY_LATE = "the policy was late"
    POLICY_BUSY = "the policy is still at an earlier step"
    SKIPPED = "a period was skipped"


class Stop(IntEnum):
    """Kind of stop; the value is the exit code of ``colift nao run``."""

    OPERATOR = 10
    """Ctrl-C, the operator's key, another signal that ends a process, or a vanished terminal."""
    ROBOT_LOST = 11
    """No connection to the robot, or no answer in time."""
    CAPTURE_LOST = 12
    """No motion capture for longer than the limit of holds."""
    CAPTURE_UNUSABLE = 13
    """Implausible motion capture for longer than the limit of holds."""
    POLICY = 14
    """A policy that fails or is late for longer than the limit of holds, or tilts or shakes the
    table."""
    MOTORS = 15
    """Hands that do not follow their commands or follow another client's, or limp motors."""
    CONTROLLER = 16
    """This machine was away: stopped, suspended, paused, or too busy."""

    @classmethod
    def after(cls, hold: HoldReason) -> "Stop":
        """Return the kind of stop after a hold that lasts too long."""
        if hold in (HoldReason.STALE, HoldReason.FEW):
            return cls.CAPTURE_LOST
        if hold in (HoldReason.POLICY_FAILED, HoldReason.POLICY_LATE, HoldReason.POLICY_BUSY):
            return cls.POLICY
        if hold is HoldReason.SKIPPED:
            return cls.CONTROLLER
        return cls.CAPTURE_UNUSABLE


class StopTrialError(Exception):
    """The trial must stop now."""

    def __init__(self, stop: Stop, reason: str) -> None:
        super().__init__(reason)
        self.stop = stop
        self.reason = reason


@contextmanager
def losses_stop() -> Iterator[None]:
    """Turn the loss of the robot, of the motion capture or of control into a stop."""
    try:
        yield
    except RobotLostError as error:
        raise StopTrialError(Stop.ROBOT_LOST, str(error)) from error
    except RobotTakenError as error:
        raise StopTrialError(Stop.MOTORS, str(error)) from error
    except CaptureLostError as error:
        raise StopTrialError(Stop.CAPTURE_LOST, str(error)) from error
