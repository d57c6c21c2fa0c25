"""Golden traces: every policy on a few lifts of its task, and two people, bit for bit.

The other suites of a task are there with some policies: all suites are frozen in 0.2.0. Two people
and one policy of each suite are played always, all others by the slow tests.

A change that is meant to change no number leaves them as they are. One that is meant to writes
them anew: ``COLIFT_GOLDEN=write pytest -m "" tests/benchmark/test_golden.py``. They are the same on
each Python, with each NumPy and each PyBullet; on another processor they are, or the test is
skipped. ``COLIFT_GOLDEN_FILE`` names another file for them: of this machine, by another Python.
"""

import hashlib
import json
import os
from dataclasses import replace
from pathlib import Path

import pytest
from colift.agents.loading.policy_spec import PolicySpec
from colift.base.registry import own_policies
from colift.benchmark.execution.provenance import fingerprint
from colift.benchmark.execution.runner import run_suite
from colift.benchmark.results.baselines import HUMAN_HUMAN, human_human_run
from colift.benchmark.suites.suite import make_suite

FILE = Path(os.environ.get("COLIFT_GOLDEN_FILE") or Path(__file__).with_name("golden.json"))
SHIPPED = {"binaries", "linear_algebra", "numpy", "pybullet", "python"}
"""What comes with a Python and its packages, and has changed no bit."""
SUITES = {"quick-v1": "level", "agree-v1": "agree", "ball-v1": "ball", "intent-v1": "intent"}
"""The suites in which every policy of a task plays, and this task."""

OTHERS = {"paper-v1": 2, "robust-v1": 41, "session-v1": 20, "standard-v1": 31}
"""The other suites, and the distance of the lifts that are played."""

SOME = ("copy", "blend", "learned")
"""The policies that play them."""

REMEMBERING = (
    *("acquainted", "recall", "refined"),
    *("session_anticipate", "session_blend", "session_linear"),
)
"""The policies that play whole sessions."""


def players(suite):
    """Return the policies that play a suite here: of the tasks, those that can do no other."""
    if suite in OTHERS:
        return [HUMAN_HUMAN, *(REMEMBERING if suite == "session-v1" else SOME)]
    task = SUITES[suite]
    level = {*own_policies("level")} - {"copy"} if task != "level" else set()
    return [HUMAN_HUMAN, *(name for name in own_policies(task) if name not in level)]


PLAYERS = {suite: players(suite) for suite in (*SUITES, *OTHERS)}
NAMES = [f"{suite} {name}" for suite, names in PLAYERS.items() for name in names]
ALWAYS = {f"{suite} {name}" for suite, names in PLAYERS.items() for name in names[:2]}


def lifts(name):
    """Return suites of some lifts that together have several behaviours, people and timings."""
    suite = make_suite(name)
    if name in OTHERS:
        seeds = suite.seeds if suite.session else suite.seeds[:1]
        return (replace(suite, scenarios=suite.scenarios[:: OTHERS[name]], seeds=seeds),)
    if SUITES[name] == "level":
        return suite, replace(suite, seeds=(3,)).with_timing(0.15, 0.05)
    scenarios = suite.scenarios[::8]
    return (
        replace(suite, scenarios=scenarios, seeds=(1,)),
        replace(suite, scenarios=scenarios[:1], seeds=(2,)).with_timing(0.15, 0.05),
    )


def played(text):
    """Return a digest for each lift: of its trace, and of its scores."""
    chosen, name = text.split()
    runs = [
        human_human_run(suite) if name == HUMAN_HUMAN else run_suite(PolicySpec(text=name), suite)
        for suite in lifts(chosen)
    ]
    return {
        f"{each.behaviour} {each.subject} {each.seed}": [
            each.trace.digest()[:16],
            hashlib.sha256(repr(each.scores).encode()).hexdigest()[:16],
        ]
        for run in runs
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


@pytest.mark.parametrize(
    "name",
    [pytest.param(name, marks=[] if name in ALWAYS else pytest.mark.slow) for name in NAMES],
)
def test_no_bit_has_changed(name, golden):
    found, there = played(name), of_the_machine(golden["platform"])
    for entry, here in of_the_machine(fingerprint()).items():
        if found != golden["lifts"][name] and here != there[entry]:
            pytest.skip(
                f"these are not the bits of another {entry}: {here!r}, not {there[entry]!r}"
            )
    assert found == golden["lifts"][name]
