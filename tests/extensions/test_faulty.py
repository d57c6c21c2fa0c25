"""Faults of other packages: each is named in one line, and nothing else is affected by it."""

from pathlib import Path

import pytest
from colift.agents.loading.policy_spec import PolicySpec
from colift.base.errors import InputError
from colift.base.registry import TASKS, lookup
from colift.benchmark.execution.runner import run_suite
from colift.benchmark.suites.catalogue import make_scenario
from colift.benchmark.suites.suite import Suite
from colift.testing import check_task

from . import faulty


@pytest.fixture(autouse=True)
def installed(install):
    """Install the package for the time of a test."""
    install(faulty.__file__, faulty.ENTRY_POINTS)


def fault(done):
    """Return the only line of a command that has refused its input."""
    assert done.returncode == 2, done.stdout + done.stderr
    assert done.stderr.startswith("error: ")
    assert done.stderr.count("\n") == 1
    return done.stderr


@pytest.mark.parametrize(
    ("suite", "told"),
    [
        ("many", "suite 'many' (faulty:many) must return a Suite, got a list"),
        ("empty", "suite 'empty' has no scenario"),
        ("confused", "suite 'confused' (faulty:confused) raised AttributeError: 'Scenario' object"),
        ("confused", "faulty.py:{line}"),
        ("other", "suite 'other' (faulty:other) returned a suite named 'another'"),
        ("absent", "suite 'absent' (no_such_module:absent) of the package faulty cannot be loaded"),
    ],
)
def test_a_suite_that_cannot_be_made_is_named(colift, suite, told):
    lines = Path(faulty.__file__).read_text().splitlines()
    line = 1 + lines.index('    return make_scenario("smooth").nothing')
    assert told.format(line=line) in fault(colift("run", "copy", "--suite", suite))


@pytest.mark.parametrize(
    ("behaviour", "told"),
    [
        (
            "flat",
            "behaviour 'flat' (faulty:Flat): plan() of draw-1, seed 0, returned an array; it must "
            "return colift.agents.humans.Plan",
        ),
        (
            "gap",
            "behaviour 'gap' (faulty:Gap): plan() of draw-1, seed 0, returned a plan whose target",
        ),
        (
            "stuck",
            "'stuck' (faulty:Stuck): plan() of draw-1, seed 0, raised AttributeError: 'Plan'",
        ),
        ("deaf", "'deaf' (faulty:Deaf): plan() of draw-1, seed 0, raised TypeError: Deaf.plan()"),
        ("mute", "human behaviour 'mute' (faulty:Mute) has no method plan()"),
        ("plain", "human behaviour 'plain' (faulty:Plain) must itself be a frozen dataclass"),
        ("smooth,noise=0", "behaviours take no parameters here: 'smooth' has those of its class"),
    ],
)
def test_a_behaviour_without_plans_is_named(colift, behaviour, told):
    options = ("--suite", "quick-v1", "--seeds", "0:1", "--behaviour", behaviour)
    assert told in fault(colift("run", "hold", *options))


def test_a_lift_to_be_drawn_names_its_behaviour(colift):
    for out in ("a.png", "a.html"):
        told = fault(colift("render", "copy", "--behaviour", "gap", "--out", out))
        assert "behaviour 'gap' (faulty:Gap): plan() of S1, seed 0, returned a plan whose" in told


@pytest.mark.parametrize(
    ("task", "told"),
    [
        ("wide", "'wide' (faulty:Wide): in smooth/S1, seed 0, robot_observation() has 6 numbers"),
        ("unscored", "smooth/S1, seed 0, score() lacks human_force_n; it must return one number"),
        ("endless", "'endless' (faulty:Endless): in smooth/S1, seed 0, score() returned human_f"),
        ("untrue", "failure() returned False; it must return a reason or None"),
        ("short", "series() returned gap of shape (3,); it must have one number per frame"),
        ("lost", "'lost' (faulty:Lost): failure() in smooth/S1, seed 0, raised AttributeError"),
        ("renamed", "task 'renamed' (faulty:Renamed) has the name 'level'; it must have its"),
        ("tall", "task 'tall' (faulty:Tall) must have a default for each field: height"),
        ("made", "task 'made' (faulty:made) must be a class, got an object of Wide"),
    ],
)
def test_a_task_that_breaks_a_rule_is_named(colift, task, told):
    assert told in fault(colift("render", "hold", "--task", task, "--out", "a.html"))


def test_an_error_of_a_task_is_not_tried_again(monkeypatch):
    scenario, reached = make_scenario("smooth", task="lost"), []
    task = type(scenario.task)
    before = task.failure

    def counted(self, lift):
        reached.append(lift.frame)
        return before(self, lift)

    monkeypatch.setattr(task, "failure", counted)
    suite = Suite(name="lost lifts", scenarios=(scenario,), seeds=(0, 1))
    with pytest.raises(InputError, match=r"task 'lost' .* raised AttributeError"):
        run_suite(PolicySpec(text="hold"), suite)
    assert reached.count(100) == 1


def test_the_name_of_a_task_is_that_of_its_entry_point():
    with pytest.raises(AssertionError, match="faulty:Renamed has the name 'level'; its entry"):
        check_task(lookup(TASKS, "renamed")())


def test_all_else_is_listed(colift):
    done = colift("list", COLUMNS="200")
    assert done.returncode == 1
    assert done.stderr == ""
    lines = done.stdout.splitlines()
    [absent] = [line for line in lines if line.startswith("  absent ")]
    assert "cannot be loaded: ModuleNotFoundError: No module named 'no_such_module'" in absent
    assert any(line.split()[:3] == ["wide", "More", "numbers"] for line in lines)


def test_bundles_of_other_suites_are_verified(colift):
    options = ("--suite", "quick-v1", "--seeds", "0:1", "--behaviour", "pause", "--out", "mine")
    assert colift("run", "hold", *options).returncode == 0
    verified = colift("verify", "mine")
    assert verified.returncode == 0, verified.stderr


def test_a_bundle_that_cannot_be_verified_is_announced(colift):
    done = colift("run", "hold", "--suite", "own-people", "--out", "mine")
    assert done.returncode == 0, done.stderr
    assert "note: the result bundle cannot be verified, since suite 'own-people'" in done.stderr
    assert "Next: " not in done.stdout
    assert "there is no recipe" in colift("verify", "mine").stderr
