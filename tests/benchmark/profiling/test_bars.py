"""The bars of ``colift bench``: kept or missed."""

import math

import pytest
from colift.benchmark.profiling import bars
from colift.cli import bench


@pytest.mark.parametrize("name", [name for name, each in bars.FIGURES.items() if each.bar])
def test_a_bar_is_kept_at_its_limit_and_missed_beyond(name):
    figure = bars.FIGURES[name]
    limit = figure.least if figure.most is None else figure.most
    worse = math.nextafter(limit, -math.inf if figure.most is None else math.inf)
    assert bars.missed({name: limit}) == []
    assert bars.missed({name: worse}) == [f"{name} is {limit:.3g}, must be {figure.bar}"]
    assert bars.missed({name: math.nan}) != []


def test_a_figure_without_a_bar_misses_none():
    assert bars.missed({"sim_speed": 0.0}) == []


def test_the_table_shows_bars_and_verdicts():
    shown = bench._figures_table("t", {"sim_speed": 9.0, "dask_ratio": 0.79, "verify_ratio": 1.4})
    columns = [[str(cell) for cell in column.cells] for column in shown.columns]
    assert columns[2:4] == [["", "at least 0.8", "at least 1"], ["", "MISSED", "kept"]]
