"""Golden traces: every policy on ``quick-v1``, bit for bit.

A change that is meant to change no number leaves them as they are. One that is meant to writes
them anew: ``COLIFT_GOLDEN=write pytest tests/benchmark/test_golden.py``.
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

FILE = Path(__file__).with_name("golden.json")
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


def platform():
    """Return what bits may depend on besides colift."""
    return {name: value for name, value in fingerprint().items() if name != "simulation"}


@pytest.fixture(scope="module")
def golden():
    if os.environ.get("COLIFT_GOLDEN") == "write":
        content = {"platform": platform(), "lifts": {name: played(name) for name in NAMES}}
        FILE.write_text(json.dumps(content, indent=1, sort_keys=True) + "\n")
    content = json.loads(FILE.read_text())
    other = [name for name, value in platform().items() if value != content["platform"][name]]
    if other:
        pytest.skip(f"the golden traces are of another {other[0]}: here {platform()[other[0]]}")
    return content["lifts"]


@pytest.mark.parametrize("name", NAMES)
def test_no_bit_has_changed(name, golden):
    assert played(name) == golden[name]
