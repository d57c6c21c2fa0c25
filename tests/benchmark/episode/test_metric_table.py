"""The table of metrics, and what is written from it."""

import contextlib

from colift.agents.policies.copy import Copy
from colift.benchmark.episode.lift import Lift
from colift.benchmark.episode.loop import run_episode
from colift.benchmark.episode.metric import on_boards
from colift.benchmark.suites.catalogue import make_scenario
from colift.benchmark.tasks.level.task import LEVEL

METRICS = LEVEL.metrics


def test_every_score_has_its_entry_in_the_same_order():
    with contextlib.closing(Lift(make_scenario("smooth"))) as lift:
        assert [*METRICS] == [*run_episode(lift, Copy(), 0).scores]


def test_symbols_name_one_metric_each_and_boards_show_none_twice():
    assert len({each.symbol for each in METRICS.values()}) == len(METRICS)
    shown = [each.name for each in on_boards(METRICS)]
    assert shown[:2] == ["sparc", "human_force_n"]
    assert len(set(shown)) == len(shown)


def test_a_value_is_written_with_the_digits_of_its_metric():
    assert METRICS["sparc"].text(-1.234) == "-1.23"
    assert METRICS["robot_lag_ms"].text(12.6) == "13"
    assert METRICS["robot_lag_ms"].text(None) == "none"
