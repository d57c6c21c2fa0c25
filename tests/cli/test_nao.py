"""``colift nao`` as a user meets it: over the real protocols on loopback.

The robot and the motion capture are another process. So is the command where it is killed, hangs,
or is one of two.
"""

import json
import signal
import subprocess
import sys
import threading
import time

import numpy as np
import pytest
from colift.agents.extras import how_to_install
from colift.agents.hardware.trial_log import read_trial

COMMAND = [sys.executable, "-m", "colift.cli", "nao"]

WITHOUT_EXTRA = """
import sys
from importlib.machinery import PathFinder

class Bare(PathFinder):
    hidden = ("qi", "pylsl")

    @classmethod
    def find_spec(cls, name, path=None, target=None):
        return None if name in cls.hidden else super().find_spec(name, path, target)

    @classmethod
    def find_distributions(cls, context=None):
        found = PathFinder.find_distributions(context)
        return (each for each in found if each.name not in cls.hidden)

sys.meta_path[sys.meta_path.index(PathFinder)] = Bare
from colift.cli.main import main
main()
"""


def nao(*arguments):
    """Run ``colift nao`` and return the finished process."""
    return subprocess.run(
        [*COMMAND, *map(str, arguments)], capture_output=True, text=True, timeout=200
    )


def answered(run, tries=3):
    """Return what a run comes to on a machine that lets the emulator answer in time.

    Where other processes keep it from that for 150 ms, the robot counts as lost.
    """
    for _ in range(tries):
        done = run()
        if "no answer within 0.15 s" not in done.stderr:
            break
    return done


def happened(laboratory, before):
    """Return what has happened at the server since a line, but for its own lack of time."""
    return [line for line in laboratory.lines[before:] if not line.startswith("behind the clock")]


@pytest.fixture(scope="module")
def lifted(laboratory, tmp_path_factory):
    """Lift once with the emulated NAO, and return the process and what it wrote."""
    folder = tmp_path_factory.mktemp("trials")
    written = ("--record", folder / "csv", "--out", folder / "out")
    options = ("--trials", 1, "--duration", 5, "--yes", "--json", *written)
    return nao("run", "blend", *laboratory.place, *options), folder


def test_check_finds_robot_and_stream_and_nothing_moves(colift, laboratory):
    before = len(laboratory.lines)
    done = colift("nao", "check", *laboratory.place)
    assert done.returncode == 0, done.stdout
    assert "MISSING" not in done.stdout
    for told in (
        "qi: 3",
        "pylsl: 1",
        "NAOqi 2.8.7-emulated",
        "-0.030 to 0.290 m",
        "fall manager: on",
        "autonomous life: disabled",
        "12 channels at 100 Hz",
        "age of the newest frame: median",
        "frames a second",
        "commanded by: nobody",
    ):
        assert told in done.stdout
    assert happened(laboratory, before) == []


def test_a_dry_run_sends_the_robot_no_motion(colift, laboratory, tmp_path):
    before = len(laboratory.lines)
    options = ("--dry-run", "--trials", 1, "--duration", 3, "--record", tmp_path)
    done = colift("nao", "run", "copy", *laboratory.place, *options)
    assert done.returncode == 0, done.stderr
    assert "dry run" in done.stdout
    laboratory.await_line("lift 1 is over")
    assert happened(laboratory, before) == [
        "say Lift 1. Go!",
        "lift 1 seed 0",
        "lift 1 is over",
    ]
    trial = read_trial(tmp_path / "lift-01.csv")
    assert max(step.command for step in trial.log.steps) > 0.05
    assert trial.dry


def test_a_lift_is_scored_as_a_simulated_one(lifted):
    done, folder = lifted
    assert done.returncode == 0, done.stderr
    content = json.loads(done.stdout)
    assert content == json.loads((folder / "out" / "results.json").read_text())
    assert content["summary"]["failed"] == 0
    assert 5 < content["summary"]["rmse_mm"]["mean"] < 30
    assert content["groups"][0]["sparc"]["mean"] < 0
    timing = content["hardware"]["timing"]
    assert timing["steps"] > 40
    for name in ("sensing_age_ms", "state_ms", "policy_ms", "command_ms", "period_error_ms"):
        assert 0 < timing[name]["p50"] <= timing[name]["p99"] <= timing[name]["max"]
    with np.load(folder / "out" / "traces.npz") as traces:
        human, robot = traces["human_end"], traces["robot_end"]
    assert human.max() > 0.1
    assert robot.max() > 0.1
    assert 1000 * np.sqrt(np.mean((human - robot) ** 2)) == pytest.approx(
        content["summary"]["rmse_mm"]["mean"]
    )


def test_its_recording_replays_to_the_same_commands_bit_for_bit(colift, lifted):
    _, folder = lifted
    done = colift("nao", "replay", folder / "csv" / "lift-01.csv")
    assert done.returncode == 0, done.stderr
    assert "every command equal to the bit" in done.stdout


def test_another_policy_is_told_from_the_recorded_one(colift, lifted):
    _, folder = lifted
    done = colift("nao", "replay", folder / "csv" / "lift-01.csv", "--policy", "copy")
    assert done.returncode == 1
    assert "the commands differ, step" in done.stderr


def test_its_recording_says_how_the_laboratory_is(colift, lifted):
    _, folder = lifted
    done = colift("nao", "calibrate", folder / "csv" / "lift-01.csv", "--json")
    found = json.loads(done.stdout)
    assert found["capture_noise"] == pytest.approx(0.00023, rel=0.15)
    assert found["stiffness"] == pytest.approx(18, rel=0.25)
    assert 0.003 < found["sag"] < 0.007
    assert 0.01 < found["capture_age"] < 0.3


def test_ctrl_c_stops_the_hands_and_says_so(laboratory):
    before = len(laboratory.lines)
    run = subprocess.Popen(
        [*COMMAND, "run", "blend", *laboratory.place, "--yes"],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
    )
    deadline = time.monotonic() + 60
    while not any(line.startswith("lift") for line in laboratory.lines[before:]):
        assert time.monotonic() < deadline
        time.sleep(0.05)
    time.sleep(1.0)
    run.send_signal(signal.SIGINT)
    # Another one, while the arms are released, changes nothing.
    while not any(line.startswith("stiffness 0") for line in laboratory.lines[before:]):
        assert time.monotonic() < deadline + 60
        time.sleep(0.05)
    run.send_signal(signal.SIGINT)
    _, errors = run.communicate(timeout=60)
    assert run.returncode == 10
    assert "STOPPED (OPERATOR): stopped by the operator: SIGINT" in errors
    lines = happened(laboratory, before)
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


class Running:
    """A ``colift nao run`` that goes on, and when it told what."""

    def __init__(self, *arguments):
        self.process = subprocess.Popen(
            [*COMMAND, "run", *map(str, arguments)],
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
    assert "one at a time" in second.stderr
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


def test_check_says_what_is_missing(colift, lsl_on_loopback):
    done = colift("nao", "check", "--robot", "tcp://127.0.0.1:9", "--mocap", "lsl:nobody")
    assert done.returncode == 1
    assert "MISSING robot: no NAOqi at tcp://127.0.0.1:9" in done.stdout
    assert "MISSING motion capture: no stream 'nobody'" in done.stdout


@pytest.mark.parametrize("command", [["check"], ["run", "blend"], ["emulate"]])
def test_without_the_extra_it_is_named(command):
    done = subprocess.run(
        [sys.executable, "-c", WITHOUT_EXTRA, "nao", *command],
        capture_output=True,
        text=True,
        timeout=100,
    )
    assert done.returncode == (1 if command == ["check"] else 2)
    assert "qi is not installed" in done.stdout + done.stderr
    assert how_to_install("nao") in done.stdout + done.stderr
    assert "Traceback" not in done.stderr


def test_a_simulated_laboratory_needs_no_network(colift, tmp_path):
    options = ("--robot", "world:pause/S2", "--trials", 1, "--duration", 3)
    first, again = (
        colift("nao", "run", "minimum_jerk", *options, "--json", "--record", tmp_path / name)
        for name in "ab"
    )
    assert first.returncode == 0, first.stderr
    assert json.loads(first.stdout)["suite"] == "NAO trials (simulated)"
    files = [tmp_path / name / "lift-01.csv" for name in "ab"]
    assert files[0].read_bytes() == files[1].read_bytes()
    assert first.stdout == again.stdout


def test_somebody_elses_policy_runs_in_a_sandbox(colift, tmp_path):
    path = tmp_path / "mine.py"
    path.write_text(
        "import os\n"
        "class Mine:\n"
        "    def reset(self, seed): pass\n"
        "    def act(self, observation):\n"
        f"        assert not os.path.exists({str(tmp_path / 'key')!r})\n"
        "        return [observation[0] - observation[3]]\n"
    )
    (tmp_path / "key").write_text("secret")
    options = ("--robot", "world", "--trials", 1, "--duration", 2, "--json")
    done = colift("nao", "run", f"{path}:Mine", *options)
    assert done.returncode == 0, done.stderr
    content = json.loads(done.stdout)
    assert content["isolation"] != "none"
    assert content["hardware"]["timing"]["held"] == {}
    assert content["summary"]["failed"] == 0


@pytest.mark.parametrize(
    ("arguments", "told"),
    [
        (("run", "nobody"), "nobody"),
        (("run", "blend", "--mocap", "vicon:x", "--robot", "tcp://127.0.0.1:9"), "127.0.0.1:9"),
        (("run", "blend", "--control-period", "0.01"), "0.02 to 0.5 s"),
        (("run", "blend", "--robot", "world:dance"), "dance"),
        (("run", "blend", "--robot-markers", ","), "at least one marker"),
        (("run", "blend", "--up", "W"), "X, Y or Z"),
        (("emulate", "--subject", "S9"), "S9"),
        (("emulate", "--fault", "fire@1"), "unknown fault 'fire'"),
        (("replay", "none.csv"), "cannot read none.csv"),
    ],
)
def test_what_is_typed_wrong_is_named(colift, arguments, told):
    done = colift("nao", *arguments)
    assert done.returncode == 2
    assert told in done.stderr
