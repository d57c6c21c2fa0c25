"""``colift nao`` as a user meets it: over the real protocols on loopback.

The robot and the motion capture are another process.
"""

import json
import socket
import subprocess
import sys
from contextlib import closing, contextmanager

import numpy as np
import pytest
from colift.agents.hardware.trial_log import read_trial
from colift.base.extras import how_to_install

from ..agents.hardware.conftest import PatientSession

pytestmark = pytest.mark.slow

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
    command = [sys.executable, "-m", "colift.cli", "nao", *map(str, arguments)]
    return subprocess.run(command, capture_output=True, text=True, timeout=200)


@pytest.fixture(scope="module")
def lifted(laboratory, tmp_path_factory):
    """Lift once with the emulated NAO, and return the process and what it wrote."""
    folder = tmp_path_factory.mktemp("trials")
    written = ("--record", folder / "csv", "--out", folder / "out")
    options = ("--trials", 1, "--duration", 5, "--yes", "--json", *written)
    return nao("run", "blend", *laboratory.place, *options), folder


def test_check_finds_robot_and_stream_and_nothing_moves(colift, laboratory):
    before = laboratory.mark()
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
        f"{laboratory.stream} of {socket.gethostname()} (source id {laboratory.url})",
        "temperatures: 38 °C or less",
        "battery: 90 %",
        "breathing: off",
        "idle posture: off",
    ):
        assert told in done.stdout
    assert laboratory.happened_since(before) == []


@contextmanager
def faulty(laboratory, *faults):
    """Let a laboratory have faults."""
    with closing(PatientSession(laboratory.url)) as session:
        for fault in faults:
            session.call("ColiftFaults", "request", fault)
        try:
            yield
        finally:
            session.call("ColiftFaults", "clear", within=3.0)


def test_check_and_run_refuse_a_robot_that_is_not_well(colift, laboratory):
    before = laboratory.mark()
    with faulty(laboratory, "hot@0:99:81", "battery@0", "breathing@0", "idle-posture@0"):
        checked = colift("nao", "check", *laboratory.place)
        refused = colift("nao", "run", "blend", *laboratory.place, "--yes")
    assert checked.returncode == 1
    for told in (
        "MISSING temperatures: LElbowRoll 81 °C: let the robot rest",
        "MISSING battery: 10 %",
        "MISSING breathing: on in LArm, RArm: switch it off",
        "MISSING idle posture: on in LArm, RArm",
    ):
        assert told in checked.stdout
    assert refused.returncode == 2
    assert "the robot must not lift: temperatures: LElbowRoll 81 °C" in refused.stderr
    lines = laboratory.happened_since(before)
    assert not any(line.startswith("motion") for line in lines)


def test_a_robot_that_becomes_hot_lifts_no_more(colift, emulate):
    heating = emulate("--fault", "hot@1")
    options = ("--yes", "--json", "--trials", 3, "--duration", 3)
    done = colift("nao", "run", "blend", *heating.place, *options)
    assert done.returncode == 2, done.stderr
    assert "the robot must not lift: temperatures: LElbowRoll 76 °C" in done.stderr
    content = json.loads(done.stdout)
    assert (content["summary"]["episodes"], content["summary"]["failed"]) == (1, 0)
    assert "the arms are released" in done.stderr
    assert not any(line.startswith("say Lift 2") for line in heating.lines)


def test_two_motion_captures_of_a_name_are_refused_and_one_can_be_chosen(colift, emulate):
    ours = emulate()
    theirs = emulate("--stream", ours.stream)
    told = f"2 streams are called '{ours.stream}': "
    sources = [
        f"{ours.stream} of {socket.gethostname()} (source id {each.url})" for each in (ours, theirs)
    ]
    checked = colift("nao", "check", *ours.place)
    assert checked.returncode == 1
    assert f"MISSING motion capture: {told}{'; '.join(sorted(sources))}" in checked.stdout
    refused = colift("nao", "run", "blend", *ours.place, "--yes")
    assert refused.returncode == 2
    assert told in refused.stderr
    assert not any(line.startswith("motion") for line in (*ours.lines, *theirs.lines))
    chosen = ("--mocap", f"lsl:{ours.stream}@{ours.url}")
    checked = colift("nao", "check", "--robot", ours.url, *chosen)
    assert checked.returncode == 0, checked.stdout
    assert sources[0] in checked.stdout
    options = ("--dry-run", "--trials", 1, "--duration", 1)
    done = colift("nao", "run", "copy", "--robot", ours.url, *chosen, *options)
    assert done.returncode == 0, done.stderr
    assert f"motion capture: {sources[0]}" in done.stderr


def test_a_dry_run_sends_the_robot_no_motion(colift, emulate, tmp_path):
    """In a laboratory as it starts: earlier lifts may leave a table that is off the hands."""
    laboratory = emulate()
    before = laboratory.mark()
    options = ("--dry-run", "--trials", 1, "--duration", 3, "--record", tmp_path)
    done = colift("nao", "run", "copy", *laboratory.place, *options)
    assert done.returncode == 0, done.stderr
    assert "dry run" in done.stdout
    laboratory.await_line("lift 1 is over")
    assert laboratory.happened_since(before) == [
        "say Lift 1. Go!",
        "lift 1 seed 0",
        "lift 1 is over",
    ]
    trial = read_trial(tmp_path / "lift-01.csv")
    assert max(step.command for step in trial.log.steps) > 0.05
    assert trial.dry


@pytest.mark.usefixtures("lifted")
def test_a_dry_run_does_not_ask_hands_without_motors_to_follow(colift, laboratory, tmp_path):
    """After a lift the robot rests, and its hands hang lower than they were last commanded."""
    options = ("--dry-run", "--trials", 1, "--duration", 1, "--record", tmp_path)
    done = colift("nao", "run", "copy", *laboratory.place, *options)
    assert done.returncode == 0, done.stderr
    log = read_trial(tmp_path / "lift-01.csv").log
    assert len(log.steps) >= 9
    assert {step.set_point - step.hand_height for step in log.steps} == {0.0}
    number = sum(line.startswith("say Lift") for line in laboratory.lines)
    laboratory.await_line(f"lift {number} is over")


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


@pytest.mark.parametrize("command", [("verify",), ("compare", "copy")])
def test_its_bundle_cannot_be_simulated_again(colift, lifted, command):
    done = colift(*command, lifted[1] / "out")
    told = "there is no recipe, since trials of a robot cannot be simulated again"
    assert told in " ".join(done.stderr.split())
    assert done.returncode in (1, 2)


def test_trials_and_bundles_that_are_there_are_kept(colift, tmp_path):
    run = ("nao", "run", "copy", "--robot", "world:smooth/S1", "--trials", 1, "--yes")
    record, out = ("--record", tmp_path / "csv"), ("--out", tmp_path / "out")
    assert colift(*run, *record, *out).returncode == 0
    first = (tmp_path / "csv" / "lift-01.csv").read_bytes()
    refused = colift(*run, *record, *out)
    assert refused.returncode == 2
    assert "holds the result bundle of earlier trials; name a new folder" in refused.stderr
    assert colift(*run, *record).returncode == 0
    assert {path.name for path in (tmp_path / "csv").iterdir()} == {"lift-01.csv", "lift-02.csv"}
    assert (tmp_path / "csv" / "lift-01.csv").read_bytes() == first


STOPPED = """
import signal
from colift.agents.hardware.session import Session
from colift.cli.main import main

play, numbers = Session.play, iter(range(2))

def stopped(*arguments, **options):
    if next(numbers) == 1:
        signal.raise_signal(signal.SIGINT)
    return play(*arguments, **options)

Session.play = stopped
main()
"""
"""A run on a robot that is stopped before its second trial, as by Ctrl-C."""


def test_a_bundle_of_stopped_trials_is_kept(colift, tmp_path):
    out = tmp_path / "out"
    run = ("nao", "run", "copy", "--robot", "world:smooth/S1", "--trials", "2", "--yes", "--out")
    command = [sys.executable, "-c", STOPPED, *run, str(out)]
    assert subprocess.run(command, capture_output=True, timeout=200).returncode == 10
    assert not json.loads((out / "results.json").read_text())["complete"]
    traces = (out / "traces.npz").read_bytes()
    refused = colift(*run, out)
    assert refused.returncode == 2
    assert "holds the result bundle of earlier trials; name a new folder" in refused.stderr
    assert (out / "traces.npz").read_bytes() == traces


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


def test_trials_with_one_person_have_no_interval_and_say_so(colift):
    done = colift("nao", "run", "copy", "--robot", "world:smooth/S1", "--trials", 2)
    assert done.returncode == 0, done.stderr
    assert "with one person, so that there is no interval" in " ".join(done.stdout.split())
    assert "quartiles" not in done.stdout
    assert "95 %" not in done.stdout


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
        (("replay", "none.csv"), "none.csv: cannot be read"),
    ],
)
def test_what_is_typed_wrong_is_named(colift, arguments, told):
    done = colift("nao", *arguments)
    assert done.returncode == 2
    assert told in done.stderr
