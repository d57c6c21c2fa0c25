"""Trials at a robot that end before their time, or do not begin: over the real protocols.

The robot and the motion capture are another process. So is the command where it is interrupted,
hangs, or is one of two.
"""

import json
import signal
import subprocess
import sys
import threading
import time

import pytest
from colift.agents.hardware.trial_log import read_trial

pytestmark = pytest.mark.slow


def answered(run, tries=3):
    """Return what a run comes to on a machine that lets the emulator answer in time.

    Where other processes keep it from that for 150 ms, the robot counts as lost.
    """
    for _ in range(tries):
        done = run()
        if "no answer within 0.15 s" not in done.stderr:
            break
    return done


class Running:
    """A ``colift nao run`` that goes on, and when it told what."""

    def __init__(self, *arguments):
        self.process = subprocess.Popen(
            [sys.executable, "-m", "colift.cli", "nao", "run", *map(str, arguments)],
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            text=True,
        )
        self.told = []
        self._reader = threading.Thread(target=self._read)
        self._reader.start()

    def _read(self):
        for line in self.process.stderr:
            self.told.append((time.monotonic(), line.strip()))

    def comes_to(self, line, laboratory, seconds=60):
        """Return whether the laboratory has a line that begins so before the run is over."""
        end = time.monotonic() + seconds
        while not any(each.startswith(line) for each in laboratory.lines):
            if self.process.poll() is not None or time.monotonic() > end:
                return False
            time.sleep(0.02)
        return True

    def await_end(self):
        """Return the exit code and what went to the standard output."""
        output = self.process.stdout.read()
        self.process.wait(100)
        self._reader.join()
        self.process.stdout.close()
        self.process.stderr.close()
        return self.process.returncode, output

    def when(self, text, seconds=60):
        """Return when a text was told [s]; wait until it is."""
        end = time.monotonic() + seconds
        while time.monotonic() < end:
            for at, line in list(self.told):
                if text in line:
                    return at
            time.sleep(0.02)
        raise AssertionError(f"{text!r} is not told, but {self.told}")


def running(emulate, line, *options, tries=3):
    """Return a laboratory, and a run in it that has come to a line; tried again as `answered`."""
    for _ in range(tries):
        laboratory = emulate()
        run = Running("blend", *laboratory.place, "--yes", "--json", *options)
        if run.comes_to(line, laboratory):
            return laboratory, run
        run.process.kill()
        run.await_end()
    pytest.fail(f"no run came to {line!r}; the last one: {run.told}")


def test_ctrl_c_stops_the_hands_and_says_so(emulate):
    laboratory, run = running(emulate, "lift 1 seed")
    time.sleep(1.0)
    run.process.send_signal(signal.SIGINT)
    # Another one, while the arms are released, changes nothing.
    laboratory.await_line("stiffness 0")
    run.process.send_signal(signal.SIGINT)
    code, _ = run.await_end()
    assert code == 10
    assert run.when("STOPPED (OPERATOR): stopped by the operator: SIGINT")
    lines = laboratory.happened_since(0)
    frozen = lines.index("killAll")
    assert not any(line.startswith("motion") for line in lines[frozen:])
    assert lines[frozen:].index("stiffness 0 2") < lines[frozen:].index("rest")


def test_a_robot_that_dies_ends_the_run_with_its_exit_code(colift, emulate):
    dying = emulate("--fault", "disconnect@1")
    done = colift("nao", "run", "blend", *dying.place, "--yes", "--json")
    assert done.returncode == 11
    assert "STOPPED (ROBOT_LOST)" in done.stderr
    assert "NOT released" in done.stderr
    assert json.loads(done.stdout)["summary"]["failed"] == 1


@pytest.mark.parametrize("during", ["lift 1 seed", "motion angleInterpolation"])
def test_a_robot_that_hangs_is_told_at_once_and_nothing_is_claimed_of_its_arms(emulate, during):
    hanging, run = running(emulate, during)
    # In the middle of a lift, or while the arms go to the rest posture: the call that moves them
    # is waited for, as long as the robot answers others.
    time.sleep(1.0 if during.startswith("lift") else 0.0)
    hanging.process.send_signal(signal.SIGSTOP)
    told = run.when("nothing is known of the arms")
    code, _ = run.await_end()
    hanging.process.send_signal(signal.SIGCONT)
    # It is told before the robot is waited for, 3 s long, and not after that.
    assert run.when("NOT released") - told > 2.0
    lines = [line for _, line in run.told]
    assert code == 11
    assert not any("go limp" in line or "are released" in line for line in lines)
    assert lines[-1].startswith("the arms are NOT released")


def test_a_second_client_is_refused_before_it_moves_anything(colift, emulate):
    for _ in range(3):
        taken, first = running(emulate, "lift 1 seed", "--trials", 1, "--duration", 6)
        second = colift("nao", "run", "copy", *taken.place, "--yes")
        code, output = first.await_end()
        # As for `answered`: a robot that a busy machine keeps from answering counts as lost, and a
        # policy that it keeps from answering is not waited for.
        held = json.loads(output)["hardware"]["timing"]["held"] if code == 0 else {}
        if code != 11 and not held:
            break
    assert second.returncode == 2, second.stderr
    assert f"is commanded by process {first.process.pid} on" in second.stderr
    assert "only one client at a time" in second.stderr
    for moved in ("take hold", "rest heights", "go limp", "released"):
        assert moved not in second.stderr
    assert code == 0, first.told
    assert held == {}
    # One took hold and one released: the first.
    assert sum(line.startswith("motion angleInterpolation") for line in taken.lines) == 1
    assert sum(line.startswith("stiffness 0") for line in taken.lines) == 1
    # It has given the robot up: the next one may.
    claims = [line for line in taken.lines if line.startswith("memory Colift/Commander")]
    assert claims[-1].endswith("['', '', 0]")


def test_a_lift_that_was_stopped_has_its_exit_code_and_its_report(colift, emulate, tmp_path):
    def run():
        frozen = emulate("--fault", "freeze@1:99:2")
        out = ("--out", tmp_path / "out", "--record", tmp_path)
        return colift("nao", "run", "blend", *frozen.place, "--yes", "--json", *out)

    done = answered(run)
    assert done.returncode == 13, done.stderr
    assert "H1, H2 frozen: the same height to the bit" in done.stderr
    assert "Traceback" not in done.stderr
    assert json.loads(done.stdout)["summary"]["failed"] == 1
    assert (tmp_path / "out" / "results.json").exists()
    assert read_trial(tmp_path / "lift-01.csv").log.stop == 13
    assert done.stderr.splitlines()[-1] == "the arms are released, the robot is at rest"


def test_a_storm_of_reversals_is_stopped(colift, emulate, tmp_path):
    path = tmp_path / "storm.py"
    path.write_text(
        "class Storm:\n"
        "    def reset(self, seed): self.sign = 1\n"
        "    def act(self, observation):\n"
        "        self.sign = -self.sign\n"
        "        return [0.5 * self.sign]\n"
    )
    storm = emulate()
    command = ("nao", "run", f"{path}:Storm", *storm.place, "--yes", "--json")
    done = answered(lambda: colift(*command))
    assert done.returncode == 14, done.stderr
    assert "the policy shakes the table" in done.stderr
    assert json.loads(done.stdout)["hardware"]["timing"]["steps"] <= 30
