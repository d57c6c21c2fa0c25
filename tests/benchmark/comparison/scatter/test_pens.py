"""One scene as a figure for files, and as SVG of a page."""

import re
import xml.etree.ElementTree as ET

import pytest
from colift.benchmark.comparison.compare import Comparison
from colift.benchmark.comparison.front import FrontPoint
from colift.benchmark.comparison.scatter.figure import scatter_figure, scene_size
from colift.benchmark.comparison.scatter.scene import ScatterScene, make_scene
from colift.benchmark.comparison.scatter.svg import svg
from colift.benchmark.rendering.layout import LAYOUTS, PAGE, Layout
from colift.benchmark.statistics import Estimate
from matplotlib.figure import Figure


@pytest.fixture(scope="module", params=LAYOUTS.values(), ids=LAYOUTS)
def layout(request: pytest.FixtureRequest) -> Layout:
    found: Layout = request.param
    return found


@pytest.fixture(scope="module")
def scene(comparison: Comparison, layout: Layout) -> ScatterScene:
    return make_scene(
        comparison.points,
        comparison.results.axes,
        axis="RMSE, mm",
        size=scene_size(layout),
        title=("A", "b"),
    )


@pytest.fixture(scope="module")
def figure(scene: ScatterScene, layout: Layout) -> Figure:
    return scatter_figure(scene, layout)


def written(scene: ScatterScene) -> list[str]:
    return [
        *(line for dot in scene.dots if dot.label for line in dot.label.lines),
        *(note.text for note in scene.notes),
        *(tick.text for ticks in (scene.across, scene.up, scene.ratios) for tick in ticks),
        *(scene.axis, *scene.title),
    ]


def test_both_write_all_the_text_of_the_scene(scene: ScatterScene, figure: Figure) -> None:
    element = ET.fromstring(svg(scene, "wide"))
    (axes,) = figure.axes
    for texts in (
        [each.text for each in element.iter("text")],
        [each.get_text() for each in axes.texts],
    ):
        assert set(written(scene)) <= set(texts)


def test_names_are_no_wider_than_their_boxes(scene: ScatterScene, figure: Figure) -> None:
    (axes,) = figure.axes
    extents = {text.get_text(): text.get_window_extent().width for text in axes.texts}
    for dot in scene.dots:
        assert dot.label is not None
        for line in dot.label.lines:
            assert extents[line] <= dot.label.box[2] - dot.label.box[0]


def test_all_text_of_a_file_is_inside_the_picture(figure: Figure) -> None:
    for text in figure.axes[0].texts:
        box = text.get_window_extent()
        assert figure.bbox.x0 <= box.x0 < box.x1 <= figure.bbox.x1
        assert figure.bbox.y0 <= box.y0 < box.y1 <= figure.bbox.y1


def test_every_point_says_what_it_is(scene: ScatterScene) -> None:
    element = ET.fromstring(svg(scene, "wide"))
    assert [each.text for each in element.iter("title")] == [dot.tip for dot in scene.dots]
    assert element.get("aria-label") == scene.summary


def test_the_page_gives_all_colours(scene: ScatterScene) -> None:
    values = re.findall(r'(?:fill|stroke)="([^"]+)"', svg(scene, "wide"))
    assert all(value == "none" or value.startswith("var(--") for value in values)


def test_a_name_is_no_markup(comparison: Comparison) -> None:
    value = Estimate(mean=10.0, ci95=(9.0, 11.0))
    one = FrontPoint(
        name="<b>$x_1$ & y</b>", rmse_mm=value, second=Estimate(mean=-2, ci95=(-3, -1))
    )
    scene = make_scene([one], comparison.results.axes, axis="RMSE")
    texts = [each.text for each in ET.fromstring(svg(scene, "wide")).iter("text")]
    drawn = [each.get_text() for each in scatter_figure(scene, PAGE).axes[0].texts]
    assert one.name in texts
    assert one.name in drawn
