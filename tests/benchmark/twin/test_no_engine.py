"""The twin without the engine, in a process in which PyBullet cannot be imported."""

import os
import subprocess
import sys

import pytest

WITHOUT = """
import sys
sys.modules["pybullet"] = None
from colift.benchmark.twin.libraries import require_jax
require_jax()
"""


@pytest.fixture
def run(compiling):
    """Return what runs code in a process without an engine, and gives it when it has ended."""

    def ended(code):
        command = [sys.executable, "-c", WITHOUT + code]
        environment = {**os.environ, **compiling}
        return subprocess.run(command, env=environment, capture_output=True, text=True, timeout=300)

    return ended


@pytest.mark.slow
@pytest.mark.parametrize("given", [{"task": "level", "unsettled": 0}, {"task": "agree"}])
def test_the_twin_and_its_trainers_need_no_engine(run, given):
    code = f"""
from colift.benchmark.training.apg import updates
from colift.benchmark.training.apg_settings import ApgSettings
settings = ApgSettings(updates=1, lifts=4, batch=2, units=2, wide=0, **{given})
for update in updates(settings, 0):
    assert update.rmse_mm > 0
"""
    done = run(code)
    assert done.returncode == 0, done.stderr


def test_the_command_line_starts_without_an_engine(run):
    done = run("import colift.cli.main")
    assert done.returncode == 0, done.stderr


def test_a_lift_in_the_engine_says_what_to_install(run):
    done = run("import colift; colift.make('smooth').reset(seed=0)")
    assert "lifts in the engine need PyBullet, which is not installed" in done.stderr
    assert "pip install pybullet" in done.stderr
