"""The scripts in ``examples/`` run as they stand."""

import runpy
import sys
from pathlib import Path

import pytest
from colift.agents.registry import SUITES, entries

EXAMPLES = Path(__file__).parents[1] / "examples"


def test_these_are_all():
    assert {path.name for path in EXAMPLES.glob("*.py")} == {"plot_plans.py", "readings.py"}


def test_plot_plans_draws_a_picture(tmp_path, monkeypatch):
    monkeypatch.setattr(sys, "argv", ["plot_plans.py", str(tmp_path / "plans.png")])
    runpy.run_path(str(EXAMPLES / "plot_plans.py"))
    assert (tmp_path / "plans.png").read_bytes().startswith(b"\x89PNG")


def test_readings_prints_a_row_for_each_reading(monkeypatch, capsys):
    known = entries(SUITES)
    monkeypatch.setitem(known, "paper-v1", known["quick-v1"])
    runpy.run_path(str(EXAMPLES / "readings.py"))
    heading, _, *rows = capsys.readouterr().out.splitlines()
    assert heading.startswith("| reading | RMSE mm |")
    errors = [float(row.split("|")[2]) for row in rows]
    assert len(set(errors)) == 4
    assert errors == pytest.approx([16.0] * 4, abs=8.0)
