"""Exclusive control of a robot: a claim in its ALMemory, kept alive by a heartbeat.

The key :data:`KEY` holds the name of the holder, a token and the number of the heartbeat; without a
name, the robot is free. A claim is alive while its heartbeat advances on the observer's clock: no
two clocks are compared. Two clients that claim at once both write, wait, and read: the last writer
holds the claim. Every heartbeat reads before it writes; a client that has lost the claim notices
and stops.

NAOqi itself accepts commands of any client; one without a claim is detected by the set-points that
it moves.
"""

import os
import socket
import threading
import uuid
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from typing import Final, NamedTuple

from colift.agents.hardware.nao.naoqi import STALE, NaoqiArm
from colift.agents.hardware.ports import Clock, Naoqi, RobotLostError
from colift.agents.hardware.setup import wait
from colift.agents.hardware.stops import losses_stop
from colift.base.errors import InputError

KEY: Final = "Colift/Commander"
"""The claim's key in ALMemory."""

BEAT: Final = 0.5
"""Time between two heartbeats [s]."""

SETTLED: Final = 0.3
"""Time between writing a claim and reading it again [s]: longer than a call may take."""


class Holder(NamedTuple):
    """Holder of the claim on a robot."""

    name: str
    """Empty if the robot is free."""
    token: str
    """Unique to this claim."""
    beat: int
    """Number of the last heartbeat."""


NOBODY: Final = Holder("", "", 0)


def holder(session: Naoqi) -> Holder:
    """Return the holder of the claim on a robot, dead or alive.

    Raises
    ------
    RobotLostError
        If the robot does not answer.
    """
    if KEY not in session.call("ALMemory", "getDataList", KEY):
        return NOBODY
    try:
        name, token, beat = session.call("ALMemory", "getData", KEY)
        return Holder(str(name), str(token), int(beat))
    except (TypeError, ValueError):
        return Holder("a claim that cannot be read", "", 0)


class RobotClaim:
    """A claim on a robot.

    Parameters
    ----------
    session
        The connection.
    """

    def __init__(self, session: Naoqi) -> None:
        self._session = session
        self._own = Holder(f"process {os.getpid()} on {socket.gethostname()}", uuid.uuid4().hex, 0)
        self._beating = threading.Lock()

    @property
    def token(self) -> str:
        """What distinguishes this claim from others."""
        return self._own.token

    def take(self, clock: Clock, *, dead: bool = False) -> None:
        """Take the claim; a dead one is taken over.

        Parameters
        ----------
        clock
            The time.
        dead
            Whether the present claim is known to be dead.

        Raises
        ------
        InputError
            If another client holds it.
        RobotLostError
            If the robot does not answer.
        StopTrialError
            If the operator stops.
        """
        if not dead:
            self._await_nobody(clock)
        self._write(self._own)
        wait(clock, SETTLED)
        self._refuse(holder(self._session))

    def _await_nobody(self, clock: Clock) -> None:
        """Return when the robot is free, or the present claim is dead."""
        first = holder(self._session)
        end = clock.now() + STALE
        while first.name and clock.now() < end:
            wait(clock, BEAT / 2)
            now = holder(self._session)
            if not now.name:
                return
            if now != first:
                self._refuse(now)

    def _refuse(self, found: Holder) -> None:
        if found.token != self._own.token:
            raise InputError(
                f"the robot at {self._session.url} is commanded by {found.name}, and takes "
                "only one client at a time: end that one first (a claim without a heartbeat is "
                f"taken over after {STALE:g} s)"
            )

    def beat(self) -> str:
        """Send a heartbeat; return the name of another holder, or an empty text.

        Raises
        ------
        RobotLostError
            If the robot does not answer.
        """
        with self._beating:
            found = holder(self._session)
            if found.token != self._own.token:
                return found.name or "nobody"
            self._own = self._own._replace(beat=self._own.beat + 1)
            self._write(self._own)
            return ""

    def release(self) -> None:
        """Release the claim, if it is still held."""
        with suppress(RobotLostError):
            if holder(self._session).token == self._own.token:
                self._write(NOBODY)

    def _write(self, value: Holder) -> None:
        self._session.call("ALMemory", "insertData", KEY, list(value))


@contextmanager
def claimed(arm: NaoqiArm, clock: Clock, *, dead: bool = False) -> Iterator[RobotClaim]:
    """Hold the claim on a robot, with a heartbeat; if it is lost, set ``taken`` of the arm.

    Parameters
    ----------
    arm, clock
        The robot and the time.
    dead
        Whether the present claim is known to be dead.

    Raises
    ------
    InputError
        If another client holds it; nothing has been moved.
    StopTrialError
        If the robot does not answer, or the operator stops.
    """
    claim = RobotClaim(arm.session)
    try:
        with losses_stop():
            claim.take(clock, dead=dead)
    except BaseException:
        # It may have been written already.
        claim.release()
        raise

    def look() -> None:
        other = claim.beat()
        if other:
            arm.taken = f"the robot is commanded by {other} now: its claim is not this one's"

    arm.look = look
    over = threading.Event()
    heart = threading.Thread(target=_beat, args=(arm, over), name="claim", daemon=True)
    heart.start()
    try:
        yield claim
    finally:
        over.set()
        heart.join()
        claim.release()


def _beat(arm: NaoqiArm, over: threading.Event) -> None:
    """Send heartbeats until ``over`` is set; the loop detects a robot that does not answer."""
    while not arm.taken and not over.wait(BEAT):
        with suppress(RobotLostError):
            arm.look()
