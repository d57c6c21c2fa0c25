"""``colift figures`` as a maintainer meets it."""

import pytest
from colift.benchmark.figures.registry import FOLDER, REGISTRY

FIGURES = """
[people]
command = "echo S1 S2"
suites = ["quick-v1"]

[lifts]
command = "cat lifts.csv"
recordings = ["lifts.csv"]
suites = ["quick-v1"]

[speed]
command = "echo fast"
machine = true
"""


@pytest.fixture
def root(tmp_path, monkeypatch):
    """A clone with figures of its own."""
    (tmp_path / FOLDER).mkdir(parents=True)
    (tmp_path / FOLDER / REGISTRY).write_text(FIGURES)
    monkeypatch.setattr("colift.cli.figures.clone_folder", lambda: tmp_path)
    return tmp_path


def test_figures_are_listed_and_made_when_due(colift, root):
    code, shown, _ = colift("figures")
    assert code == 0
    assert shown.count("due: never made") == 2
    assert shown.count("by name: never made") == 1
    assert colift("figures", "--check").returncode == 1
    code, shown, errors = colift("figures", "--remake")
    assert code == 1
    assert shown == "people.txt: new\n"
    assert errors == "lifts needs lifts.csv, which colift does not contain: give --recordings\n"
    (root / "l.csv").write_text("trial\n")
    code, shown, _ = colift("figures", "--remake", "--recordings", "l.csv")
    assert (code, shown) == (0, "lifts.txt: new\n")
    assert colift("figures", "--check").returncode == 0
    assert colift("figures", "--remake") == (0, "", "")


def test_a_named_figure_is_made_in_any_case(colift, root):
    assert colift("figures", "--remake", "speed").stdout == "speed.txt: new\n"
    assert colift("figures", "--remake", "speed").stdout == "speed: unchanged\n"
    code, shown, _ = colift("figures", "speed", "people", "--check")
    assert code == 1
    assert "speed" in shown
    assert "lifts" not in shown
    assert colift("figures", "speed", "--check").returncode == 0


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (("nothing",), "unknown figure 'nothing'; figures: people, lifts, speed"),
        (("--remake", "--check"), "--remake and --check exclude each other"),
        (("--recordings", "l.csv"), "--recordings needs --remake"),
        (("--remake", "--recordings", "no.csv"), "no.csv"),
    ],
)
def test_wrong_usage_is_refused_in_a_line(colift, root, arguments, message):
    code, _, errors = colift("figures", *arguments)
    assert code == 2
    assert message in errors
    assert errors.count("\n") == 1
