"""Golden traces: every policy on ``quick-v1``, bit for bit.

A change that is meant to change no number leaves them as they are. One that is meant to writes
them anew: ``COLIFT_GOLDEN=write pytest tests/benchmark/test_golden.py``. They are the same on each
Python, with each NumPy and each PyBullet; on another processor they are, or the test is skipped.
``COLIFT_GOLDEN_FILE`` names another file for them: of this machine, by another Python.
"""

import hashlib
import json
import os
from pathlib import Path

import pytest
from colift.agents.loading.loading import PolicySpec
from colift.agents.registry import own_policies
from colift.benchmark.execution.provenance import fingerprint
from colift.benchmark.execution.runner import run_suite
from colift.benchmark.results.baselines import HUMAN_HUMAN, human_human_run
from colift.benchmark.suites.suite import make_suite

FILE = Path(os.environ.get("COLIFT_GOLDEN_FILE") or Path(__file__).with_name("golden.json"))
SHIPPED = {"binaries", "linear_algebra", "numpy", "pybullet", "python"}
"""What comes with a Python and its packages, and has changed no bit."""
NAMES = [HUMAN_HUMAN, *own_policies("level")]


def played(name):
    """Return a digest for each lift: of its trace, and of its scores."""
    suite = make_suite("quick-v1")
    run = human_human_run(suite) if name == HUMAN_HUMAN else run_suite(PolicySpec(text=name), suite)
    return {
        f"{each.behaviour} {each.subject} {each.seed}": [
            each.trace.digest()[:16],
            hashlib.sha256(repr(each.scores).encode()).hexdigest()[:16],
        ]
        for each in run.episodes
    }


def of_the_machine(platform):
    """Return what bits may depend on besides colift, a Python and its packages."""
    return {name: platform[name] for name in sorted({*platform} - {*SHIPPED, "simulation"})}


@pytest.fixture(scope="module")
def golden():
    if os.environ.get("COLIFT_GOLDEN") == "write":
        platform = {name: value for name, value in fingerprint().items() if name != "simulation"}
        content = {"platform": platform, "lifts": {name: played(name) for name in NAMES}}
        FILE.write_text(json.dumps(content, indent=1, sort_keys=True) + "\n")
    return json.loads(FILE.read_text())


@pytest.mark.parametrize("name", NAMES)
def test_no_bit_has_changed(name, golden):
    found, there = played(name), of_the_machine(golden["platform"])
    for entry, here in of_the_machine(fingerprint()).items():
        if found != golden["lifts"][name] and here != there[entry]:
            pytest.skip(
                f"these are not the bits of another {entry}: {here!r}, not {there[entry]!r}"
            )
    assert found == golden["lifts"][name]
