"""The curves of a training as a figure."""

from pathlib import Path

import numpy as np
import pytest
from colift.benchmark.rendering.figures import drawn_for, write_all
from colift.benchmark.rendering.layout import LAYOUTS, PAGE, Layout
from colift.benchmark.training.course import Course, Point
from colift.benchmark.training.curves_figure import curves_figure

from tests.printed import check_figure


def course(seed: int, *points: tuple[int, float]) -> Course:
    curve = [Point(steps=steps, seconds=1.0, rmse_mm=error) for steps, error in points]
    return Course(folder=Path(), seed=seed, identity={}, curve=curve)


COURSES = [course(0, (0, 40.0), (1_000_000, 10.0)), course(1, (0, 20.0), (2_000_000, 10.0))]


@pytest.mark.parametrize("layout", LAYOUTS.values(), ids=LAYOUTS)
def test_it_is_for_print(layout: Layout, tmp_path: Path) -> None:
    with drawn_for(layout):
        figure = curves_figure(COURSES, layout)
    write_all(tmp_path, "curves", figure, "t")
    words = check_figure(tmp_path / "curves", layout)
    assert {"steps", "each", "mean", "RMSE", "M"} <= words


def test_the_mean_is_of_all_seeds_and_ends_with_the_shortest() -> None:
    (axes,) = curves_figure(COURSES, PAGE).axes
    *seeds, mean = axes.get_lines()
    assert len(seeds) == 2
    assert list(mean.get_xdata()) == [0, 1_000_000]
    assert list(mean.get_ydata()) == [30.0, pytest.approx((10 + 15) / 2)]


def test_a_single_seed_has_one_line() -> None:
    (axes,) = curves_figure(COURSES[:1], PAGE).axes
    (line,) = axes.get_lines()
    assert np.array_equal(line.get_ydata(), [40.0, 10.0])
