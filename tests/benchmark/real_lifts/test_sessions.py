"""Recorded lifts of people in a row, as sessions."""

import csv

import numpy as np
import pytest
from colift.agents.loading.policy_spec import PolicySpec
from colift.base.errors import InputError
from colift.benchmark.bundle import Recipe, results, write_bundle
from colift.benchmark.execution.runner import run_suite
from colift.benchmark.real_lifts.suites import real_lifts
from colift.benchmark.suites.treatments import plain_treatments
from colift.benchmark.verification import verify

TIMES = np.arange(0.0, 4.0, 0.02)

KEEPS = """
class Policy:
    def begin_session(self):
        self.lifts = 0
    def reset(self, seed):
        self.lifts += 1
    def act(self, observation):
        return [-1e-6 * self.lifts]
"""


def write(path, names, person=lambda name: name[0]):
    """Write a lift for each name, each with a later peak than the one before."""
    rows = [
        f"{name},{time:.2f},{0.2 * np.sin(np.pi * (time / 4) ** (1 + 0.1 * i)) ** 2:.5f},"
        f"{person(name)}"
        for i, name in enumerate(names)
        for time in TIMES
    ]
    path.write_text("trial,t_s,z_m,person\n" + "\n".join(rows) + "\n")
    return path


@pytest.fixture
def path(tmp_path):
    return write(tmp_path / "lifts.csv", ["a1", "b1", "a2", "b2", "a3", "a4", "c1", "b3"])


def test_each_person_is_a_session_in_the_order_of_the_file(path):
    lifts = real_lifts(path, session=True)
    suite = lifts.suite
    assert (suite.name, suite.session) == ("recordings lifts.csv in sessions", 3)
    assert [each.trial for each in suite.scenarios] == ["a", "b"]
    assert [each.person for each in suite.scenarios] == ["a", "b"]
    played = [suite.at(place).scenario.human.recording.name for place in range(suite.size)]
    assert played == ["a1", "a2", "a3", "b1", "b2", "b3"]
    assert [suite.counts(place) for place in range(3)] == [False, True, True]
    with pytest.raises(InputError, match="a session of 3 recorded lifts has none at 3"):
        suite.with_seeds(0, 4).at(3)
    assert lifts.left_out == dict.fromkeys(("a4", "c1"), "a session has 3 lifts of each person")
    assert [each["trial"] for each in plain_treatments(suite)] == played


def test_lifts_without_a_name_are_one_persons(tmp_path):
    lifts = real_lifts(write(tmp_path / "own.csv", ["x", "y"], lambda _: ""), session=True)
    assert [each.trial for each in lifts.suite.scenarios] == ["person"]
    assert lifts.assumed == "no person is named, so all lifts are taken as one person's"


def test_lifts_without_a_name_are_not_joined_with_those_of_a_person_called_person(tmp_path):
    names = {"x1": "", "p1": "person", "x2": "", "p2": "person", "x3": ""}
    lifts = real_lifts(write(tmp_path / "own.csv", names, names.get), session=True)
    [scenario] = lifts.suite.scenarios
    assert [each.name for each in scenario.human.lifts] == ["p1", "p2"]
    reason = "its person is not named, as others are"
    assert lifts.left_out == dict.fromkeys(("x1", "x2", "x3"), reason)
    assert lifts.assumed == ""
    assert Recipe.of(lifts.suite).suite().digest == lifts.suite.digest


def test_people_with_one_lift_are_no_session(tmp_path):
    path = write(tmp_path / "own.csv", ["a1", "b1"])
    with pytest.raises(InputError, match=r"own.csv: no person has several lifts"):
        real_lifts(path, session=True)
    with pytest.raises(InputError, match="--session and --as-recorded exclude each other"):
        real_lifts(path, session=True, as_recorded=True)
    with pytest.raises(InputError, match="--session is for a file of recordings"):
        real_lifts(tmp_path, session=True)


def test_the_bundle_of_a_recorded_session_is_played_again(path, tmp_path):
    (tmp_path / "keeps.py").write_text(KEEPS)
    suite = real_lifts(path, session=True).suite
    assert Recipe.of(suite).suite().digest == suite.digest
    run = run_suite(PolicySpec(text=f"{tmp_path / 'keeps.py'}:Policy"), suite)
    first = [round(-1e6 * float(each.trace.action[0, 0])) for each in run.episodes]
    assert first == [1, 2, 3, 1, 2, 3]
    content = results(run, {})
    assert content.session.trust == ()
    write_bundle(tmp_path / "out", run, content.plain(), human_human=None)
    verdict = verify(tmp_path / "out")
    assert verdict.ok, verdict.findings
    with (tmp_path / "out" / "episodes.csv").open() as file:
        rows = [*csv.DictReader(file)]
    assert [row["trial"] for row in rows] == [*"aaabbb"]
    own = [each["slow_down"] for each in plain_treatments(suite)]
    assert [float(row["slow_down"]) for row in rows] == own
    assert len({*own}) > 1
