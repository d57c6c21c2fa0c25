import dataclasses
from collections.abc import Sequence
from itertools import pairwise

import numpy as np
import pytest
from colift.agents.loading.policy_spec import PolicySpec
from colift.benchmark.episode.drawn import DrawnSeries
from colift.benchmark.episode.loop import Episode
from colift.benchmark.episode.metric import drawn_series
from colift.benchmark.episode.trace import Trace
from colift.benchmark.execution.playing import play
from colift.benchmark.rendering.chart import Chart, Pen
from colift.benchmark.suites.catalogue import make_scenario
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.patches import Rectangle
from matplotlib.text import Text

BAR = DrawnSeries(name="bar", label="robot's hurdle", stay=0.2)
OTHER = DrawnSeries(name="other", label="human's hurdle", where="human", stay=0.2)
BALL = (
    DrawnSeries(name="ball", label="ball", where="place"),
    DrawnSeries(name="aim", label="target", where="place", goal=True),
)


def with_series(episode: Episode, **series: np.ndarray) -> Trace:
    return dataclasses.replace(episode.trace, added=series)


def hurdle(episode: Episode, height: float, start: int, stop: int) -> np.ndarray:
    series = episode.trace.target.copy()
    series[start:stop] = height
    return series


def drawn_axes(
    trace: Trace, drawn: Sequence[DrawnSeries], size: tuple[int, int], scale: float = 1.0
) -> list[Axes]:
    """Return the axes of a chart that has been drawn."""
    figure = Figure(figsize=(size[0] / 100, size[1] / 100), dpi=100)
    canvas = FigureCanvasAgg(figure)
    axes = Chart(trace, partner="robot", drawn=drawn).draw(figure, Pen(scale=scale))
    canvas.draw()
    return axes


def words_of(axes: Axes) -> dict[str, Text]:
    """Return the words on hurdles."""
    return {each.get_text(): each for each in axes.texts}


def bars_of(axes: Axes) -> list[Rectangle]:
    return [each for each in axes.patches if isinstance(each, Rectangle)]


def test_a_hurdle_is_a_bar_over_its_window_and_full_where_the_table_was_nearest(
    long_episode: Episode,
) -> None:
    """The ends rise steadily to 200 mm; they pass 100 mm in the middle, 20 mm apart."""
    trace = with_series(long_episode, bar=hurdle(long_episode, 0.10, 200, 500))
    (axes,) = drawn_axes(trace, (BAR,), (640, 204))
    window, stay = bars_of(axes)
    assert (window.get_x(), window.get_width()) == pytest.approx((2.0, 3.0))
    assert window.get_y() + window.get_height() / 2 == pytest.approx(100.0)
    assert stay.get_width() == pytest.approx(0.2)
    assert stay.get_x() + 0.1 == pytest.approx(3.74, abs=0.1)
    assert list(words_of(axes)) == ["robot's hurdle missed by 10 mm"]


def test_a_hurdle_that_the_lift_did_not_come_to_is_said_not_to_be_reached(
    long_episode: Episode,
) -> None:
    trace = with_series(long_episode, bar=hurdle(long_episode, 0.30, 670, 680))
    (axes,) = drawn_axes(trace, (BAR,), (640, 204))
    assert len(bars_of(axes)) == 1
    assert list(words_of(axes)) == ["robot's hurdle not reached"]


@pytest.mark.parametrize(("first", "second"), [(0.13, 0.11), (0.11, 0.13), (0.2, 0.05)])
@pytest.mark.parametrize(("size", "scale"), [((640, 204), 1.0), ((1290, 400), 1.6)])
def test_words_on_two_hurdles_do_not_collide(
    long_episode: Episode, first: float, second: float, size: tuple[int, int], scale: float
) -> None:
    trace = with_series(
        long_episode,
        bar=hurdle(long_episode, first, 300, 480),
        other=hurdle(long_episode, second, 310, 490),
    )
    (axes,) = drawn_axes(trace, (BAR, OTHER), size, scale)
    one, other = (each.get_window_extent() for each in words_of(axes).values())
    assert not one.overlaps(other)
    whole = axes.get_window_extent()
    for box in (one, other):
        assert whole.y0 <= box.y0 < box.y1 <= whole.y1


def test_a_ball_has_an_axis_of_its_own(long_episode: Episode) -> None:
    frames = np.arange(680)
    trace = with_series(long_episode, ball=frames / 680 * 0.4, aim=np.full(680, 0.2))
    heights, places = drawn_axes(trace, BALL, (640, 300))
    assert heights.get_ylim()[1] < 250 < places.get_ylim()[1]
    assert heights.get_xlim() == places.get_xlim()
    assert heights.get_window_extent().y0 > places.get_window_extent().y1
    assert (heights.get_ylabel(), places.get_ylabel()) == ("height [mm]", "place [mm]")
    keys = [[each.get_text() for each in axes.get_legend().texts] for axes in (heights, places)]
    assert keys == [
        ["human's end", "robot's end", "human's intention"],
        ["ball, towards the robot", "target", "error"],
    ]


@pytest.mark.parametrize("task", ["level", "agree", "ball", "intent"])
@pytest.mark.parametrize(
    ("size", "scale"), [((640, 300), 1.0), ((1200, 420), 1.6), ((1920, 600), 2.0)]
)
def test_keys_stand_in_one_line_within_the_chart(
    task: str, size: tuple[int, int], scale: float
) -> None:
    scenario = make_scenario("smooth", task=task)
    episode = next(play(PolicySpec(text="copy" if task == "level" else "hold"), scenario, (0,)))
    for axes in drawn_axes(episode.trace, drawn_series(scenario.task.metrics), size, scale):
        whole = axes.get_legend().get_window_extent()
        assert axes.get_window_extent().x0 <= whole.x0 < whole.x1 <= size[0]
        boxes = [each.get_window_extent() for each in axes.get_legend().texts]
        assert all(one.x1 < other.x0 for one, other in pairwise(boxes))
        assert np.ptp([each.y0 for each in boxes]) < 6 * scale


def test_a_chart_has_a_line_at_each_moment(long_episode: Episode) -> None:
    figure = Figure(figsize=(6.4, 2.0), dpi=100)
    chart = Chart(long_episode.trace, partner="robot")
    before = len(chart.draw(Figure(), Pen(scale=1.0))[0].lines)
    (axes,) = chart.draw(figure, Pen(scale=1.0), (100, 300))
    # A line, and a dot on each end's curve.
    assert len(axes.lines) == before + 2 * 3
