import dataclasses

import numpy as np
from colift.benchmark.episode.loop import Episode
from colift.benchmark.episode.trace import Trace
from colift.benchmark.rendering.caption import title_strip
from colift.benchmark.rendering.chart import Chart
from colift.benchmark.rendering.curves import Curves
from colift.benchmark.rendering.style import HUMAN
from numpy.typing import NDArray
from PIL import Image, ImageColor

WIDTH, HEIGHT = 640, 200


def columns_of(picture: Image.Image, colour: str) -> NDArray[np.intp]:
    """Return the columns under the legend where a colour is found in full strength."""
    pixels = np.asarray(picture)[30:]
    return np.flatnonzero((pixels == ImageColor.getrgb(colour)).all(axis=-1).any(axis=0))


def curves_of(trace: Trace) -> Curves:
    return Curves(Chart(trace, partner="robot"), WIDTH, HEIGHT)


def test_what_is_to_come_is_pale(long_episode: Episode) -> None:
    curves = curves_of(long_episode.trace)
    half, end = curves.at(340), curves.at(679)
    assert half.size == end.size == (WIDTH, HEIGHT)
    middle = (columns_of(end, HUMAN).min() + columns_of(end, HUMAN).max()) / 2
    assert abs(columns_of(half, HUMAN).max() - middle) < 15


def test_drawing_a_cursor_leaves_no_trace(long_episode: Episode) -> None:
    curves = curves_of(long_episode.trace)
    before = np.asarray(curves.at(100))
    curves.at(400)
    curves.marked([0, 200, 600])
    assert np.array_equal(before, np.asarray(curves.at(100)))


def test_marked_curves_have_a_cursor_at_each_moment(long_episode: Episode) -> None:
    curves = curves_of(long_episode.trace)
    plain, marked = np.asarray(curves.marked([])), np.asarray(curves.marked([100, 300, 500]))
    lines = np.flatnonzero((plain != marked).any(axis=-1).sum(axis=0) > 100)
    assert len(lines) == 3
    assert lines[1] - lines[0] == lines[2] - lines[1] > 100


def test_a_single_frame_can_be_drawn(episode: Episode) -> None:
    first = {name: getattr(episode.trace, name)[:1] for name in Trace.series()}
    one = dataclasses.replace(episode.trace, **first)
    assert curves_of(one).at(0).size == (WIDTH, HEIGHT)


def test_a_long_name_does_not_reach_the_score(episode: Episode) -> None:
    short = np.asarray(title_strip(episode, "copy", 640, 36))
    long = np.asarray(title_strip(episode, "a" * 300, 640, 36))
    assert np.array_equal(short[:, 490:], long[:, 490:])
    assert not np.array_equal(short[:, :490], long[:, :490])


def test_the_title_tells_a_failure(episode: Episode, dropped: Episode) -> None:
    fine, failed = (np.asarray(title_strip(e, "copy", 640, 36)) for e in (episode, dropped))
    assert not np.array_equal(fine, failed)
