"""What works on a Python for which no engine's wheel exists."""

import importlib.util
import subprocess
import sys

import pytest

COMMAND = """
import sys
sys.modules["pybullet"] = None
from colift.cli.start import start
start()
"""


@pytest.fixture
def without_engine(tmp_path):
    """Run a command where PyBullet cannot be imported."""

    def run(*arguments):
        command = [sys.executable, "-c", COMMAND, *arguments]
        return subprocess.run(command, cwd=tmp_path, capture_output=True, text=True)

    return run


def test_a_command_of_the_engine_says_what_it_needs(without_engine):
    done = without_engine("run", "copy", "--suite", "quick-v1")
    assert (done.returncode, done.stdout) == (2, "")
    assert "lifts in the engine need PyBullet" in done.stderr
    assert "wheels for Python 3.11 to 3.13" in done.stderr
    assert "Traceback" not in done.stderr


@pytest.mark.slow
@pytest.mark.skipif(importlib.util.find_spec("jax") is None, reason="JAX is not installed")
def test_a_policy_is_trained_without_it_and_scored_with_it(without_engine, colift, tmp_path):
    small = ("--updates", "2", "--lifts", "8", "--batch", "4", "--units", "4", "--unsettled", "0")
    done = without_engine("train", "apg", "--out", "out", *small)
    assert (done.returncode, done.stderr) == (0, "")
    run = colift("run", "out/seed-0", "--suite", "quick-v1", "--jobs", "1")
    assert run.returncode == 0
    assert "12 lifts, 0 failed" in run.stdout
