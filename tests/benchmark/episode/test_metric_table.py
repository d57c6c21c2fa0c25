"""The table of metrics, and what is written from it."""

import dataclasses
from pathlib import Path

from colift.benchmark.episode.scores import BOARD, METRICS, Scores

DOCS = Path(__file__).parents[3] / "docs" / "metrics.md"


def test_every_field_of_the_scores_has_its_entry_in_the_same_order():
    assert [*METRICS] == [field.name for field in dataclasses.fields(Scores)]


def test_the_docs_have_the_table():
    rows = [
        f"| `{each.name}` | {each.unit} | {each.better} | "
        f"{'' if each.missing == 'never' else each.missing} | {each.meaning} |"
        for each in METRICS.values()
    ]
    assert "\n".join(rows) in DOCS.read_text()


def test_symbols_name_one_metric_each_and_boards_show_none_twice():
    assert len({each.symbol for each in METRICS.values()}) == len(METRICS)
    assert [each.name for each in BOARD] == ["sparc", "human_force_n"]


def test_a_value_is_written_with_the_digits_of_its_metric():
    assert METRICS["sparc"].text(-1.234) == "-1.23"
    assert METRICS["robot_lag_ms"].text(12.6) == "13"
    assert METRICS["robot_lag_ms"].text(None) == "none"
