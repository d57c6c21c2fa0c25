"""Another package's task, suite, behaviour and metric, used by every command without any edit."""

import csv
import json

import numpy as np
import pytest
from colift.base.errors import InputError
from colift.base.registry import HUMANS, SUITES, TASKS, entries, lookup
from colift.benchmark.suites.suite import make_suite
from colift.benchmark.verification.verify import verify
from colift.testing import check_behaviour, check_suite, check_task

from . import sloping


@pytest.fixture(autouse=True)
def installed(install):
    """Install the package for the time of a test."""
    install(sloping.__file__, sloping.ENTRY_POINTS)


def test_it_conforms():
    check_task(lookup(TASKS, "slope")())
    check_suite(make_suite("slope-v1"))
    check_behaviour(lookup(HUMANS, "shy")())


@pytest.mark.slow
def test_its_metric_is_in_the_table_the_csv_and_the_json_and_its_bundle_verifies(colift, tmp_path):
    done = colift("run", "copy", "--suite", "slope-v1", "--out", "mine", COLUMNS="82")
    assert done.returncode == 0, done.stderr
    assert "slope mm" in done.stdout
    assert all(f"\n  {name} " in done.stdout for name in ("smooth", "changing_goal"))
    rows = list(csv.DictReader((tmp_path / "mine/episodes.csv").read_text().splitlines()))
    errors = [float(row["slope_error_mm"]) for row in rows]
    assert len(errors) == 12
    content = json.loads((tmp_path / "mine/results.json").read_text())
    assert content["summary"]["slope_error_mm"]["mean"] == pytest.approx(np.mean(errors))
    # Level is 40 mm off.
    assert 35 < content["summary"]["rmse_mm"]["mean"] < 60
    with np.load(tmp_path / "mine/traces.npz") as traces:
        wanted = traces["task/wanted"]
    assert wanted.min() == pytest.approx(-0.04)
    verified = colift("verify", "mine")
    assert verified.returncode == 0, verified.stdout + verified.stderr


def test_an_error_of_its_task_while_verifying_names_the_task(colift, tmp_path, monkeypatch):
    options = ("--suite", "slope-v1", "--seeds", "0:1", "--out", "mine")
    assert colift("run", "copy", *options).returncode == 0

    def series(self, lift):
        return {"wanted": lift.nothing}

    monkeypatch.setattr(lookup(TASKS, "slope"), "series", series)
    with pytest.raises(InputError, match=r"task 'slope' .sloping:Slope.: smooth/draw-1, seed 0"):
        verify(tmp_path / "mine")


def test_a_bundle_without_its_package_has_a_hint(colift, tmp_path, monkeypatch):
    options = ("--suite", "slope-v1", "--seeds", "0:1", "--out", "mine")
    assert colift("run", "copy", *options).returncode == 0
    monkeypatch.undo()
    entries.cache_clear()
    done = colift("verify", tmp_path / "mine")
    assert done.returncode == 1
    assert "manifest.json: unknown task 'slope'" in done.stderr
    assert "or the package that registers it is not installed" in done.stderr


def test_training_in_the_twin_is_refused_before_anything_is_written(colift, tmp_path):
    done = colift("train", "apg", "--task", "slope", "--out", "t")
    assert done.returncode == 2
    words = "the task 'slope' is not stated by rules, so that it has no twin"
    assert done.stderr == f"error: {words}\n"
    assert not (tmp_path / "t").exists()


def test_policies_are_compared_by_its_metric(colift):
    done = colift("compare", "copy", "hold", "--suite", "slope-v1", COLUMNS="140")
    assert done.returncode == 0, done.stderr
    heading = next(line for line in done.stdout.splitlines() if "vs_human" in line)
    assert heading.split()[-1:] == ["slope"]


def test_everything_is_listed(colift):
    listed = " ".join(colift("list").stdout.split())
    for line in (
        "slope Keep the table at a slope",
        "slope-v1 12 lifts at a slope of 40 mm.",
        "shy Lifts to half the height",
    ):
        assert line in listed
    assert set(entries(SUITES)) > {"slope-v1", "standard-v1"}
