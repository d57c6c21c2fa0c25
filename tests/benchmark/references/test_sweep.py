import json

import pytest
from colift.benchmark.references import sweep as sweeping
from colift.benchmark.references.held_out import FIRST_SEED
from colift.benchmark.references.sweep import (
    NAMES,
    Swept,
    human_human_rmse,
    lifts_to_play,
    sweep,
    timings,
)
from colift.benchmark.references.sweep_figure import sweep_figure, sweep_json
from colift.benchmark.rendering.figures import drawn_for, write_all
from colift.benchmark.rendering.layout import LAYOUTS, PAGE
from colift.benchmark.suites.catalogue import make_scenario
from colift.benchmark.suites.suite import Suite
from colift.benchmark.training.data import Timing

from tests.printed import check_figure

SUITE = Suite(name="one", scenarios=(make_scenario("smooth", "draw-200004"),), seeds=(FIRST_SEED,))


def test_the_timings_are_a_cross_through_the_papers():
    found = timings()
    assert Timing() in found
    assert len(set(found)) == len(found)
    assert {timing.latency for timing in found} >= {0.0, 0.1, 0.2}
    assert {timing.control_period for timing in found} >= {0.02, 0.1}
    assert all(timing.latency == 0.1 or timing.control_period == 0.1 for timing in found)


def test_everyone_meets_the_same_lifts_at_every_timing(monkeypatch):
    pytest.importorskip("sklearn")
    some = (Timing(latency=0.0), Timing(control_period=0.05))
    monkeypatch.setattr(sweeping, "timings", lambda: some)
    done = []
    swept = list(sweep(SUITE, lifts=2, progress=done.append))
    assert [(s.policy, s.latency, s.control_period) for s in swept] == [
        (name, timing.latency, timing.control_period) for timing in some for name in NAMES
    ]
    human_human = human_human_rmse(SUITE, progress=done.append)
    assert sum(done) == lifts_to_play(SUITE, 2)
    assert human_human > 0.0
    by_name = {s.policy: s.rmse_mm for s in swept if s.latency == 0.0}
    assert by_name["oracle"] < by_name["blend"] < by_name["reactive"]


SWEPT = [
    Swept(policy=name, latency=t.latency, control_period=t.control_period, rmse_mm=i, sparc=-2)
    for i, name in enumerate(NAMES)
    for t in timings()
]


@pytest.mark.parametrize("layout", LAYOUTS.values(), ids=LAYOUTS)
def test_the_figure_is_for_print(layout, tmp_path):
    with drawn_for(layout):
        figure = sweep_figure(SWEPT, 9.0, layout)
    write_all(tmp_path, "sweep", figure, "t")
    assert {*NAMES, "two", "people", "latency"} <= check_figure(tmp_path / "sweep", layout)


def test_the_figure_has_a_line_for_each_in_both_panels():
    figure = sweep_figure(SWEPT, 9.0, PAGE)
    for axes, count in zip(figure.axes, (5, 5), strict=True):
        lines = {line.get_label(): line for line in axes.get_lines()}
        assert set(lines) == {"two people", *NAMES}
        for i, name in enumerate(NAMES):
            assert list(lines[name].get_ydata()) == [i] * count
        assert list(lines["oracle"].get_xdata()) == sorted(lines["oracle"].get_xdata())
    assert list(figure.axes[0].get_lines()[1].get_xdata()) == [0, 50, 100, 150, 200]
    content = json.loads(sweep_json(SWEPT, 9.0))
    assert content["human_human_rmse_mm"] == 9.0
    assert len(content["swept"]) == len(SWEPT)
