"""A controller that vanishes or is stopped: what becomes of the arms, over the real protocols.

The robot, the motion capture and the command are processes of their own.
"""

import fcntl
import os
import random
import signal
import subprocess
import sys
import time
from contextlib import closing, suppress

import pytest
from colift.agents.hardware.claim import NOBODY, holder
from colift.agents.hardware.nao.naoqi import RELEASE_TIME, STALE
from colift.agents.hardware.operator import HANDOVER

from ..agents.hardware.conftest import PatientSession

pytestmark = pytest.mark.slow

INTERRUPTS = int(os.environ.get("COLIFT_TEST_KILLS", "2"))
"""Number of random moments."""

SLACK = 6.0
"""Time that a busy machine may take for what takes a moment [s]."""


class Run:
    """A ``colift nao run`` of one lift, in a session of its own."""

    def __init__(self, laboratory, *options, **streams):
        self.laboratory = laboratory
        command = [sys.executable, "-m", "colift.cli", "nao", "run", "blend", *laboratory.place]
        streams = {"stdin": subprocess.DEVNULL, "stdout": subprocess.DEVNULL, **streams}
        self.process = subprocess.Popen(
            [*command, "--trials", "1", *options], start_new_session=True, **streams
        )

    def lifting(self, seconds=1.4):
        """Wait until the lift is on its way."""
        self.laboratory.await_line("lift 1 seed", seconds=100)
        time.sleep(seconds)
        return self

    def ends(self):
        """Return the exit code."""
        return self.process.wait(100)


def is_free(laboratory):
    """Return whether nobody claims the robot any more."""
    with closing(PatientSession(laboratory.url)) as session:
        return holder(session) == NOBODY


def released(laboratory, within):
    """Return whether the arms become limp within a time [s]; nothing moves after ``killAll``."""
    laboratory.await_line("killAll", seconds=within)
    laboratory.await_line("rest", seconds=HANDOVER + RELEASE_TIME + SLACK)
    lines = laboratory.happened_since(0)
    after = lines[lines.index("killAll") :]
    assert not any(line.startswith("motion") for line in after)
    assert after.index("stiffness 0 2") < after.index("rest")
    return True


@pytest.fixture
def run(emulate):
    """Start a run, with an emulator of its own; none is left behind."""
    started = []

    def start(*options, **streams):
        started.append(Run(emulate(), *options, **streams))
        return started[-1]

    yield start
    for each in started:
        with suppress(ProcessLookupError):
            each.process.send_signal(signal.SIGCONT)
            each.process.kill()
        each.process.wait()


@pytest.mark.parametrize(
    "name",
    ["SIGHUP", *(pytest.param(each, marks=pytest.mark.slow) for each in ("SIGQUIT", "SIGTSTP"))],
)
def test_a_hang_up_ends_like_the_stop_button(run, name):
    begun = run("--yes").lifting()
    begun.process.send_signal(getattr(signal, name))
    at = time.monotonic()
    assert released(begun.laboratory, SLACK)
    assert time.monotonic() - at > HANDOVER
    assert begun.ends() == 10
    assert is_free(begun.laboratory)


CONTROLLED = """
import fcntl, os, sys, termios
if {controlling}:
    fcntl.ioctl(0, termios.TIOCSCTTY, 0)
os.execv(sys.executable, [sys.executable, *sys.argv[1:]])
"""
"""A process that takes its input as its controlling terminal, and becomes another."""


@pytest.mark.parametrize("controlling", [True, pytest.param(False, marks=pytest.mark.slow)])
def test_a_terminal_that_vanishes_ends_like_the_stop_button(emulate, controlling):
    """Its operator confirms each step, and is gone in the middle of the lift."""
    laboratory = emulate()
    master, slave = os.openpty()
    process = subprocess.Popen(
        [
            *(sys.executable, "-c", CONTROLLED.format(controlling=controlling)),
            *("-m", "colift.cli", "nao", "run", "blend", *laboratory.place, "--trials", "1"),
        ],
        stdin=slave,
        stdout=slave,
        stderr=slave,
        start_new_session=True,
    )
    os.close(slave)
    try:
        told, end = "", time.monotonic() + 120
        while "lift 1 seed 0" not in laboratory.lines:
            told += read(master)
            if told.count("Enter when ready") > told.count("\0"):
                told += "\0"
                os.write(master, b"\n")
            assert process.poll() is None, told
            assert time.monotonic() < end, told
        time.sleep(1.4)
        os.close(master)
        assert released(laboratory, SLACK)
        assert process.wait(100) == 10
        assert is_free(laboratory)
    finally:
        process.kill()
        process.wait()


def read(master):
    """Return what is written to a terminal within a moment."""
    fcntl.fcntl(master, fcntl.F_SETFL, os.O_NONBLOCK)
    time.sleep(0.05)
    with suppress(BlockingIOError):
        return os.read(master, 4096).decode()
    return ""


def test_nobody_who_reads_the_messages_ends_like_the_stop_button(run):
    begun = run("--yes", stderr=subprocess.PIPE).lifting()
    begun.process.stderr.close()
    assert released(begun.laboratory, SLACK)
    assert begun.ends() == 10


def test_a_controller_that_was_stopped_sends_nothing_but_the_stop(run):
    begun = run("--yes", stderr=subprocess.PIPE).lifting()
    begun.process.send_signal(signal.SIGSTOP)
    time.sleep(2.0)
    stopped = begun.laboratory.mark()
    begun.process.send_signal(signal.SIGCONT)
    at = time.monotonic()
    assert released(begun.laboratory, SLACK)
    assert time.monotonic() - at > HANDOVER
    happened = begun.laboratory.happened_since(stopped)
    assert next(line for line in happened if not line.startswith("lift")) == "killAll"
    assert begun.ends() == 16
    told = begun.process.stderr.read().decode()
    begun.process.stderr.close()
    assert "STOPPED (CONTROLLER): this machine was away for 2." in told
    assert is_free(begun.laboratory)


def test_a_controller_that_is_stopped_for_long_is_replaced_by_its_watchdog(run):
    begun = run("--yes", stderr=subprocess.PIPE).lifting()
    begun.process.send_signal(signal.SIGSTOP)
    assert released(begun.laboratory, STALE + SLACK)
    begun.process.send_signal(signal.SIGCONT)
    assert begun.ends() == 16
    told = begun.process.stderr.read().decode()
    begun.process.stderr.close()
    assert "watchdog: the arms are released" in told
    assert is_free(begun.laboratory)


@pytest.mark.parametrize(
    "during", ["lift 1 seed", pytest.param("motion angleInterpolation", marks=pytest.mark.slow)]
)
def test_a_controller_that_is_killed_is_replaced_by_its_watchdog(run, during):
    begun = run("--yes")
    begun.laboratory.await_line(during, seconds=100)
    begun.process.kill()
    assert released(begun.laboratory, SLACK)
    begun.laboratory.await_line("memory Colift/Commander: ['', '', 0]")
    assert is_free(begun.laboratory)


@pytest.mark.parametrize("seed", range(INTERRUPTS))
def test_ctrl_c_at_any_moment_leaves_the_arms_safe(run, seed):
    """Also while it loads, and in the set-up; twice, as impatient people do."""
    moment = random.Random(seed).uniform(0.3, 12.0)
    begun = run("--yes", stderr=subprocess.PIPE)
    time.sleep(moment)
    begun.process.send_signal(signal.SIGINT)
    time.sleep(0.2)
    with suppress(ProcessLookupError):
        begun.process.send_signal(signal.SIGINT)
    code = begun.ends()
    told = begun.process.stderr.read().decode()
    begun.process.stderr.close()
    assert "Traceback" not in told
    assert code in (10, 130, -signal.SIGINT)
    lines = begun.laboratory.happened_since(0)
    if any(line.startswith(("motion", "stiffness", "wakeUp")) for line in lines):
        assert code == 10
        assert released(begun.laboratory, SLACK)
    assert is_free(begun.laboratory)
