"""Suites: what is in them, and what their digest stands for."""

import dataclasses
from dataclasses import dataclass

import numpy as np
import pytest
from colift.agents.humans import Smooth, Subject
from colift.base.errors import InputError
from colift.base.registry import SUITES, own_entries
from colift.benchmark.episode.metric import metric_table
from colift.benchmark.suites import rules
from colift.benchmark.suites.catalogue import make_scenario
from colift.benchmark.suites.ranges import RECORDED_PEOPLE
from colift.benchmark.suites.suite import make_suite, recorded_suite
from colift.benchmark.tasks.level.task import Level
from colift.benchmark.world import table


@dataclass(frozen=True)
class Other(Level):
    """Another task that has the name of its parent."""


@dataclass(frozen=True)
class Disordered(Level):
    """A task that leads with another metric."""

    metrics = metric_table(reversed([*Level.metrics.values()][:4]))


OWN_METRICS = metric_table(Level.metrics.values())


@dataclass(frozen=True)
class Measured(Level):
    """A task with a table of its own."""

    metrics = OWN_METRICS


@dataclass(frozen=True)
class Planless:
    """A behaviour without a plan."""


class Undecorated(Smooth):
    """A behaviour that is a dataclass by its parent alone."""

    share: float = 0.5


def replaced(**changes):
    return dataclasses.replace(make_scenario("smooth"), **changes)


def test_the_suites_have_the_sizes_that_their_descriptions_say():
    assert {name: make_suite(name).size for name in own_entries(SUITES)} == {
        "standard-v1": 75 * 4,
        "robust-v1": 40 * 7,
        "session-v1": 40 * 10,
        "paper-v1": 5 * 10,
        "quick-v1": 3 * 4,
        "agree-v1": 25 * 6,
        "intent-v1": 25 * 4,
        "ball-v1": 25 * 4,
    }


def test_a_digest_is_the_same_each_time_and_differs_between_suites():
    digests = [make_suite(name).digest for name in own_entries(SUITES) for _ in range(2)]
    assert digests[::2] == digests[1::2]
    assert len(set(digests)) == len(own_entries(SUITES))


@pytest.mark.parametrize(
    "change",
    [
        lambda s: dataclasses.replace(s, latency=0.05),
        lambda s: dataclasses.replace(s, control_period=0.05),
        lambda s: dataclasses.replace(
            s, subject=dataclasses.replace(s.subject, stiffness=s.subject.stiffness + 1)
        ),
        lambda s: dataclasses.replace(s, partner="human"),
    ],
)
def test_a_digest_changes_with_everything_that_changes_a_number(change):
    suite = make_suite("quick-v1")
    scenarios = (change(suite.scenarios[0]), *suite.scenarios[1:])
    assert dataclasses.replace(suite, scenarios=scenarios).digest != suite.digest


def test_a_digest_changes_with_the_seeds_but_not_with_the_name():
    suite = make_suite("quick-v1")
    assert suite.with_seeds(0, 4).digest != suite.digest
    assert suite.with_seeds(0, 1).digest == suite.digest
    assert dataclasses.replace(suite, name="other").digest == suite.digest


@pytest.mark.parametrize(("start", "stop"), [(5, 5), (5, 4), (-1, 3)])
def test_an_empty_range_of_seeds_is_refused(start, stop):
    with pytest.raises(InputError, match="0 <= A < B"):
        make_suite("quick-v1").with_seeds(start, stop)


def test_a_digest_changes_with_the_constants_of_the_world(monkeypatch):
    before = make_suite("quick-v1").digest
    monkeypatch.setattr(table, "TABLE_MASS", 0.36)
    assert make_suite("quick-v1").digest != before


def test_what_is_registered_is_made_and_checked_once(monkeypatch):
    checked = []
    for name in ("behaviour_fault", "task_fault"):
        fault = getattr(rules, name)
        note = lambda made, fault=fault: checked.append(made) or fault(made)  # noqa: E731
        monkeypatch.setattr(rules, name, note)
    suite = make_suite("standard-v1")
    assert len({id(each.task) for each in suite.scenarios}) == 1
    assert len({id(each.human) for each in suite.scenarios}) == len(checked) - 1 == 4
    assert suite.scenarios[0].human is make_scenario(suite.scenarios[0].behaviour).human


@pytest.mark.parametrize("task", [Level(), Measured()], ids=["level", "of another package"])
def test_a_digest_changes_with_the_limit_of_a_metric_but_not_with_its_words(task, monkeypatch):
    suite = make_suite("quick-v1")
    scenarios = tuple(dataclasses.replace(each, task=task) for each in suite.scenarios)
    suite = dataclasses.replace(suite, scenarios=scenarios)
    before, metric = suite.digest, task.metrics["short_of_goal_mm"]
    for changes, same in (({"label": "Missing"}, True), ({"limit": 25.0}, False)):
        changed = dataclasses.replace(metric, **changes)
        monkeypatch.setitem(task.metrics, metric.name, changed)
        assert (suite.digest == before) is same


@pytest.mark.parametrize(
    ("change", "told"),
    [
        ({"seeds": (1, 1)}, "has the seed 1 twice"),
        ({"seeds": (0, -1)}, "whole numbers from 0 as seeds, got -1"),
        ({"seeds": (0.5,)}, "whole numbers from 0 as seeds, got 0.5"),
        ({"seeds": ()}, "has no seed"),
        ({"seeds": range(3)}, "seeds in a tuple, got a range"),
        ({"scenarios": ()}, "has no scenario"),
        ({"scenarios": 2 * (make_scenario("pause", "S3"),)}, "has the scenario 'pause/S3' twice"),
        ({"scenarios": ("pause",)}, "must have scenarios, got a str"),
        (
            {"scenarios": (make_scenario("smooth"), make_scenario("pivot", task="intent"))},
            "must have one task, got level, intent",
        ),
        (
            {"scenarios": (make_scenario("smooth"), replaced(task=Other()))},
            r"must have one task, got Level\(\), Other\(\)",
        ),
        ({"scenarios": (replaced(human=Undecorated()),)}, "Undecorated.*must itself be a frozen"),
        ({"scenarios": (replaced(human=Planless()),)}, r"Planless.*has no method plan\(\)"),
        ({"scenarios": (replaced(task=Disordered()),)}, "its first metric, got max_tilt_deg"),
    ],
)
def test_a_suite_that_no_table_can_show_is_refused(change, told):
    with pytest.raises(InputError, match=told):
        dataclasses.replace(make_suite("quick-v1"), **change)


def test_an_unknown_suite_is_refused_with_the_names():
    with pytest.raises(InputError, match="paper-v1, quick-v1, robust-v1, session-v1, standard-v1"):
        make_suite("nonesuch")


def test_another_timing_is_told_in_the_name_and_in_the_digest():
    suite = make_suite("quick-v1")
    changed = suite.with_timing(0.05, None)
    assert "latency 0.05" in changed.name
    assert changed.digest != suite.digest
    assert suite.with_timing(None, None) == suite
    with pytest.raises(InputError, match="control_period"):
        suite.with_timing(None, 7.0)


def test_recordings_make_one_scenario_a_trial_each_with_the_body_of_another_person(tmp_path):
    path = tmp_path / "lifts.csv"
    times = np.arange(0, 2, 0.02)
    rows = [
        f"trial{k},{t:.2f},{0.3 * np.sin(np.pi * (t / 2) ** (1 + 0.1 * k)) ** 2:.4f}"
        for k in range(7)
        for t in times
    ]
    path.write_text("trial,t_s,z_m\n" + "\n".join(rows) + "\n")
    suite = recorded_suite(path)
    assert suite.size == 7
    assert [each.subject for each in suite.scenarios] == [
        Subject.draw(RECORDED_PEOPLE[i]) for i in range(7)
    ]
    assert {scenario.behaviour for scenario in suite.scenarios} == {"recorded"}
    assert suite.scenarios[3].trial == "trial3"
    other = recorded_suite(path)
    assert other.digest == suite.digest
    path.write_text(path.read_text().replace("0.02,0.0003", "0.02,0.0004"))
    assert recorded_suite(path).digest != suite.digest
