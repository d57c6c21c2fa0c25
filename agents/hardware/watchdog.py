"""A watchdog: it releases the arms of a robot whose client is gone or stopped.

ALMotion has no time limit for commands: after the last one, the arms complete it and stay stiff,
for as long as nobody releases them. The watchdog is a client with a connection of its own. It reads
the claim on the robot, and if a claim has had no heartbeat for :data:`.claim.STALE`, it freezes the
arms, takes the claim over, so that the former holder sends nothing more, and releases the arms.

:func:`guarded` runs it as a process that outlives its parent: it acts when the parent was killed,
crashed or hangs. A machine that loses its power, its network or its time takes both with it; for
that, a watchdog has to run on another machine (:func:`watch`).
"""

import os
import select
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from typing import Final

from colift.agents.hardware.claim import BEAT, Holder, RobotClaim, claimed, holder
from colift.agents.hardware.clocks import MonotonicClock
from colift.agents.hardware.nao.naoqi import STALE, NaoqiArm
from colift.agents.hardware.nao.session import NaoqiSession, leave
from colift.agents.hardware.operator import HANDOVER
from colift.agents.hardware.ports import RobotLostError
from colift.agents.hardware.release import release
from colift.agents.hardware.stops import StopTrialError
from colift.agents.hardware.terminal import tell
from colift.base.errors import InputError

START_TIME: Final = 60.0
"""Longest time until a watchdog process is ready [s]."""

END_TIME: Final = 30.0
"""Longest wait for a watchdog process that releases the arms [s]."""

LOST: Final = 30.0
"""Time without an answer after which a watchdog gives the robot up [s]."""

READY: Final = b"ready\n"
"""Printed by a watchdog process when it watches."""


def watch(
    arm: NaoqiArm,
    over: Callable[[float], bool],
    *,
    token: str = "",
    gone: Callable[[], bool] = lambda: False,
) -> None:
    """Watch the claim on a robot, and release the arms when it is dead.

    Parameters
    ----------
    arm
        The robot, with a connection of the watchdog's own.
    over
        Waits for so many seconds; returns whether to end.
    token
        The claim to watch, until it is released; with none, any claim that has a heartbeat, one
        after the other.
    gone
        Returns whether the holder is known to have ended.

    Raises
    ------
    RobotLostError
        If the robot does not answer for :data:`LOST`.
    """
    clock = MonotonicClock()
    seen, since, answered = holder(arm.session), clock.now(), clock.now()
    # A claim that was dead from the beginning says nothing of the arms.
    alive = token == seen.token
    while not over(BEAT / 2):
        now = clock.now()
        try:
            found = holder(arm.session)
        except RobotLostError:
            if now - answered > LOST:
                raise
            since = now  # Nothing is known of the heartbeat.
            continue
        before, answered = answered, now
        if token and found.token != token:
            return
        # After a pause of its own, the watchdog lets the holder show that it is there.
        if found != seen or now - before > 2 * BEAT:
            alive |= found != seen
            seen, since = found, now
        if found.name and (gone() or (alive and now - since > STALE)):
            _take_over(arm, clock, found)
            alive = False
            if token:
                return


def _take_over(arm: NaoqiArm, clock: MonotonicClock, dead: Holder) -> None:
    """Freeze and release the arms in place of the claim's holder."""
    arm.stop()
    tell(f"watchdog: {dead.name} commanded the robot and is gone; the arms are frozen")
    try:
        with claimed(arm, clock, dead=True):
            release(arm, clock, lambda line: tell(f"watchdog: {line}"), _hand_over)
    except (InputError, StopTrialError) as error:
        tell(f"watchdog: {error}")


def _hand_over() -> None:
    time.sleep(HANDOVER)


@contextmanager
def guarded(arm: NaoqiArm, claim: RobotClaim) -> Iterator[None]:
    """Let a watchdog process watch this process's claim on a robot; it ends with the body.

    It belongs to no terminal: a hang-up or Ctrl-C does not reach it. If it has taken the claim
    over, this waits until it has released the arms.

    Raises
    ------
    InputError
        If it does not start.
    """
    command = [sys.executable, "-m", __name__, arm.session.url, claim.token]
    process = subprocess.Popen(
        command,
        bufsize=0,
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        start_new_session=True,
    )
    assert process.stdin is not None
    assert process.stdout is not None
    with process.stdin, process.stdout:
        waits, _, _ = select.select([process.stdout], [], [], START_TIME)
        if not waits or process.stdout.readline() != READY:
            process.kill()
            process.wait()
            raise InputError(f"the watchdog of the robot at {arm.session.url} does not start")
        try:
            yield
        finally:
            _dismiss(process)


def _dismiss(process: subprocess.Popen[bytes]) -> None:
    """End a watchdog process, unless it is releasing the arms."""
    assert process.stdin is not None
    with suppress(BrokenPipeError):
        process.stdin.write(b"over\n")
    try:
        process.wait(END_TIME)
    except subprocess.TimeoutExpired:
        process.kill()
        process.wait()


class _Parent:
    """The process that has started a watchdog, by what it writes to the watchdog's input."""

    def __init__(self) -> None:
        self._ended = False

    def dismisses(self, seconds: float) -> bool:
        """Wait; return whether the parent has written something."""
        if self._ended:
            time.sleep(seconds)
        elif select.select([0], [], [], seconds)[0]:
            # The end of the input, without a line before it, says that the parent is gone.
            self._ended = not os.read(0, 64)
            return not self._ended
        return False

    def ended(self) -> bool:
        """Return whether the parent has ended without a word."""
        return self._ended


def main() -> None:
    """Watch one claim; started by :func:`guarded`, with the robot's address and the token."""
    url, token = sys.argv[1:]
    arm, parent = NaoqiArm(NaoqiSession(url)), _Parent()
    sys.stdout.buffer.write(READY)
    sys.stdout.flush()
    try:
        watch(arm, parent.dismisses, token=token, gone=parent.ended)
    except RobotLostError as error:
        tell(f"watchdog: {error}")
    leave(0)


if __name__ == "__main__":
    main()
