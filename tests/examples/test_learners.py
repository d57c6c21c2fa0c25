"""The learners of ``examples/learners``: each writes a submission that plays its task."""

import json
import os
import subprocess
import sys
from pathlib import Path

import colift
import pytest
from colift.benchmark.suites.catalogue import make_scenario
from colift.benchmark.suites.suite import Suite

HERE = Path(__file__).parents[2] / "examples" / "learners"

pytestmark = pytest.mark.slow


ONE_UPDATE = "32768"
"""Control steps of an update of PPO."""


def ran(folder, name, *arguments):
    """Run a learner in a folder, and return what it left."""
    command = [sys.executable, str(HERE / name), *arguments]
    flags = "--xla_cpu_multi_thread_eigen=false --xla_backend_optimization_level=0"
    quick = {**os.environ, "XLA_FLAGS": flags}
    return subprocess.run(command, cwd=folder, env=quick, capture_output=True, text=True)


def learned(folder, name, *arguments):
    """Run a learner that writes its policy into a new folder, and return this folder."""
    done = ran(folder, name, *arguments, "--out", "made")
    assert done.returncode == 0, done.stderr
    assert done.stdout.endswith(": made\n")
    return folder / "made"


def error(made, behaviour, task):
    """Return the RMSE of a policy in one lift [mm]."""
    scenario = make_scenario(behaviour, "draw-100000", task=task)
    suite = Suite(name="one", scenarios=(scenario,), seeds=(0,))
    return colift.evaluate(made, suite, isolation="none").rmse_mm


@pytest.mark.parametrize(
    ("name", "arguments", "task", "behaviour"),
    [
        ("ppo.py", ("--steps", ONE_UPDATE), "level", "smooth"),
        ("mappo.py", ("--steps", ONE_UPDATE, "--critic", "own"), "level", "smooth"),
        ("mappo.py", ("--steps", ONE_UPDATE, "--critic", "all"), "intent", "pivot"),
        ("fcp.py", ("--steps", ONE_UPDATE, "--pairs", "1"), "level", "smooth"),
        ("sac.py", ("--steps", "20000"), "intent", "pivot"),
    ],
)
def test_a_learner_on_the_twin(tmp_path, name, arguments, task, behaviour):
    made = learned(tmp_path, name, *arguments, "--task", task)
    assert 0 < error(made, behaviour, task) < 250


@pytest.mark.parametrize(
    ("name", "arguments", "told"),
    [
        ("ppo.py", ("--steps", "32767"), "--steps must be finite, and 32768 or more; got 32767"),
        ("mappo.py", ("--steps", "0"), "--steps must be finite, and 32768 or more; got 0"),
        ("fcp.py", ("--steps", "inf"), "--steps must be finite, and 32768 or more; got inf"),
        ("fcp.py", ("--pairs", "0"), "--pairs must be at least 1, got 0"),
        ("sac.py", ("--steps", "16511"), "--steps must be finite, and 16512 or more; got 16511"),
        ("offline.py", ("data", "--updates", "0"), "--updates must be at least 1, got 0"),
        ("ppo.py", (), "full is not empty; name a new folder"),
        ("mappo.py", (), "full is not empty; name a new folder"),
        ("fcp.py", (), "full is not empty; name a new folder"),
        ("sac.py", (), "full is not empty; name a new folder"),
        ("offline.py", ("data",), "full is not empty; name a new folder"),
    ],
)
def test_what_a_learner_cannot_do_is_refused_before_it_learns(tmp_path, name, arguments, told):
    (tmp_path / "full").mkdir()
    (tmp_path / "full" / "note").touch()
    done = ran(tmp_path, name, *arguments, "--out", "full")
    assert (done.returncode, done.stdout, done.stderr) == (1, "", f"error: {told}\n")


def test_no_data_are_named(tmp_path):
    done = ran(tmp_path, "offline.py", "none", "--out", "made")
    assert done.returncode == 1
    assert done.stderr.startswith("error: none is not a folder that colift export wrote: ")
    assert "Traceback" not in done.stderr


@pytest.mark.parametrize("method", ["bc", "iql"])
def test_a_learner_from_data(tmp_path, method):
    export = [sys.executable, "-m", "colift", "export", "--set", "expert", "--lifts", "30"]
    subprocess.run([*export, "--out", "data"], cwd=tmp_path, check=True, capture_output=True)
    made = learned(tmp_path, "offline.py", "data", "--method", method, "--updates", "50")
    assert 0 < error(made, "smooth", "level") < 100


def test_the_table_says_why_a_learner_did_not_learn(tmp_path):
    command = [sys.executable, str(HERE / "table.py"), "made", "--steps", "1", "--seeds", "1"]
    command += ["--learners", "ppo", "--tasks", "level"]
    done = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True)
    assert done.returncode == 1
    assert "error: --steps must be finite, and 32768 or more; got 1" in done.stderr
    assert "Traceback" not in done.stderr


def test_the_table_is_made_once_and_goes_on_after_a_stop(tmp_path):
    left = tmp_path / "made" / "level" / "ppo" / "seed-0" / "policy"
    left.mkdir(parents=True)
    command = [
        sys.executable,
        str(HERE / "table.py"),
        "made",
        "--steps",
        ONE_UPDATE,
        "--seeds",
        "1",
    ]
    command += ["--learners", "ppo", "--tasks", "level", "--jobs", "2"]
    first, again = (
        subprocess.run(command, cwd=tmp_path, check=True, capture_output=True, text=True)
        for _ in range(2)
    )
    assert "ppo level 0: " in first.stderr
    assert again.stderr == ""
    assert again.stdout == first.stdout
    copy, ppo = json.loads((tmp_path / "made" / "learners.json").read_text())
    words = again.stdout.split()
    assert words[words.index("ppo") + 1] == f"{ppo['rmse_mm']:.1f}"
    assert words[words.index("copy") + 1] == f"{copy['rmse_mm']:.1f}"
    assert len(ppo["steps"]) == len(ppo["seconds"]) == len(ppo["errors_mm"])
    assert (tmp_path / "made" / "learners.png").read_bytes().startswith(b"\x89PNG")
