"""The scatter scene: every policy with its name, nothing over anything."""

import itertools

import numpy as np
import pytest
from colift.benchmark.comparison.compare import Comparison
from colift.benchmark.comparison.front import FrontPoint, exact
from colift.benchmark.comparison.scatter.scene import (
    NARROW,
    RADIUS,
    WIDE,
    Dot,
    ScatterScene,
    make_scene,
)
from colift.benchmark.episode.metric import LEADING, Metric, second_axis
from colift.benchmark.statistics import Estimate
from colift.benchmark.tasks.intent.table import INTENT_METRICS
from colift.benchmark.tasks.level.table import LEVEL_METRICS

Box = tuple[float, float, float, float]


def around(mean: float, half: float = 0.5) -> Estimate:
    return Estimate(mean=mean, ci95=(mean - half, mean + half))


AXES = LEVEL_METRICS[LEADING], second_axis(LEVEL_METRICS)


def point(name: str, rmse_mm: float, sparc: float | None = -2.0, **rest: object) -> FrontPoint:
    return FrontPoint(name=name, rmse_mm=around(rmse_mm), second=exact(sparc), **rest)  # type: ignore[arg-type]


BASELINE = point("two people", 9.5, -2.8, kind="baseline")


def crowd(size: int) -> list[FrontPoint]:
    """Policies that differ by a few millimetres, two of them not at all."""
    rng = np.random.default_rng(0)
    means, smooth = rng.uniform(1.0, 6.0, size), rng.normal(-2.0, 0.2, size)
    means[1], smooth[1] = means[0], smooth[0]
    names = (f"policy,gain={mean:.4f}"[: 6 + 3 * i] for i, mean in enumerate(means))
    return [*map(point, names, means, smooth), BASELINE]


def scene(
    points: list[FrontPoint],
    size: tuple[int, int] = WIDE,
    axes: tuple[Metric, Metric] = AXES,
) -> ScatterScene:
    return make_scene(points, axes, axis="RMSE", size=size)


def dots(drawn: ScatterScene) -> dict[str, Dot]:
    return {dot.point.name: dot for dot in drawn.dots}


def overlap(one: Box, other: Box) -> bool:
    across = one[0] < other[2] and other[0] < one[2]
    return across and one[1] < other[3] and other[1] < one[3]


def assert_clear(drawn: ScatterScene) -> None:
    """Check that names cover neither each other, nor a dot, nor a note, and are in the plot."""
    names = [dot.label.box for dot in drawn.dots if dot.label]
    markers = [
        (x - RADIUS, y - RADIUS, x + RADIUS, y + RADIUS) for x, y in (dot.at for dot in drawn.dots)
    ]
    for one, other in itertools.combinations(names, 2):
        assert not overlap(one, other)
    left, top, right, bottom = drawn.scale.plot
    for box in names:
        assert left <= box[0] < box[2] <= right
        assert top <= box[1] < box[3] <= bottom
        assert not any(overlap(box, each) for each in markers)
        assert not any(overlap(box, note.box) for note in drawn.notes)


@pytest.mark.parametrize("size", [WIDE, NARROW])
def test_all_names_of_fourteen_policies_stand_clear(size: tuple[int, int]) -> None:
    drawn = scene(crowd(14), size)
    assert all(dot.label for dot in drawn.dots)
    assert_clear(drawn)


@pytest.mark.parametrize("size", [WIDE, NARROW])
@pytest.mark.parametrize("policies", [40, 300])
def test_of_many_policies_the_best_are_named_and_the_names_stand_clear(
    policies: int, size: tuple[int, int]
) -> None:
    drawn = scene(crowd(policies), size)
    named = {dot.point for dot in drawn.dots if dot.label}
    best = min((dot.point for dot in drawn.dots), key=lambda each: each.rmse_mm.mean)
    assert {best, BASELINE} <= named
    assert len(named) > 10
    assert_clear(drawn)


def test_a_name_away_from_its_dot_has_a_line_to_it() -> None:
    for dot in scene(crowd(14), NARROW).dots:
        assert dot.label is not None
        left, top, right, bottom = dot.label.box
        x, y = dot.at
        gap = np.hypot(max(left - x, 0, x - right), max(top - y, 0, y - bottom))
        assert (dot.label.leader is not None) == (gap > 2.6 * RADIUS)


def test_a_policy_far_off_goes_to_the_strip_and_does_not_squeeze_the_rest(
    comparison: Comparison,
) -> None:
    drawn = scene(list(comparison.points))
    still = dots(drawn)["still"]
    assert drawn.scale.x[1] < 50.0
    assert drawn.scale.inner[2] < still.at[0] < drawn.scale.plot[2]
    assert not still.bars
    assert still.label is not None
    assert still.label.lines == ("still", "120 mm")


def test_a_smoothness_far_off_is_written_beside_the_name() -> None:
    rows = [point(f"p{i}", 10.0 + i, -2.0 - i / 10) for i in range(3)]
    wild = dots(scene([*rows, point("wild", 111.7, -3.66), BASELINE]))["wild"]
    assert wild.label is not None
    assert wild.label.lines == ("wild", "112 mm, SPARC \N{MINUS SIGN}3.7")


def test_a_robot_without_smoothness_is_below_all_others(comparison: Comparison) -> None:
    drawn = scene(list(comparison.points))
    still = dots(drawn).pop("still").at[1]
    assert still > drawn.scale.inner[3]
    assert all(dot.at[1] < drawn.scale.inner[3] for dot in drawn.dots if dot.point.second)


def test_some_lifts_without_smoothness_are_marked_and_explained(comparison: Comparison) -> None:
    drawn = scene(list(comparison.points))
    label = dots(drawn)["failing"].label
    assert label is not None
    assert label.lines[0] == "failing *"
    assert "* without smoothness in some lifts" in {note.text for note in drawn.notes}


def test_points_are_where_the_ticks_say() -> None:
    drawn = scene([point("a", 10.0, -2.0), point("b", 20.0, -3.0), BASELINE])
    across = {tick.text: tick.at for tick in drawn.across}
    up = {tick.text: tick.at for tick in drawn.up}
    (x, y), (u, v) = (dots(drawn)[name].at for name in "ab")
    assert (x, u) == pytest.approx((across["10"], across["20"]))
    assert (y, v) == pytest.approx((up["\N{MINUS SIGN}2.0"], up["\N{MINUS SIGN}3.0"]))


def test_policies_alike_are_all_drawn_to_scale_however_bad() -> None:
    drawn = scene([point("a", 120.0, None), point("b", 118.0, -3.0)])
    assert not drawn.scale.beyond
    assert dots(drawn)["a"].at[0] == pytest.approx(drawn.scale.across(120.0))


def test_references_do_not_push_policies_off_the_scale() -> None:
    references = [
        point("oracle", 0.1, -1.9, kind="reference"),
        point("trained", 0.2, -1.9, kind="reference"),
    ]
    drawn = scene([*(point(f"{mm}", mm) for mm in (12, 14, 34)), BASELINE, *references])
    assert not drawn.scale.beyond
    assert dots(drawn)["oracle"].at[0] == pytest.approx(drawn.scale.across(0.1))


def test_the_front_is_the_policies_that_none_beats_and_is_joined(comparison: Comparison) -> None:
    drawn = scene(list(comparison.points))
    best = [dot for dot in drawn.dots if dot.best]
    assert [dot.point.name for dot in best] == ["leader", "follower"]
    assert (drawn.front[0], drawn.front[-1]) == (best[0].at, best[1].at)
    assert drawn.summary.endswith("Not beaten in both by any other: leader, follower.")


@pytest.mark.parametrize("size", [WIDE, NARROW])
def test_the_names_of_the_front_stand_clear_of_its_line(size: tuple[int, int]) -> None:
    policies = [point("anticipate", 3.8, -2.09), point("task_model", 5.6, -2.13)]
    policies += [point("proactive", 11.8, -2.01), point("impedance", 19.1, -1.8)]
    drawn = scene([*policies, BASELINE], size)
    for dot in drawn.dots:
        assert dot.label is not None
        left, top, right, bottom = dot.label.box
        for (x, y), (u, v) in itertools.pairwise(drawn.front):
            line = (min(x, u) - 0.5, min(y, v) - 0.5, max(x, u) + 0.5, max(y, v) + 0.5)
            assert not overlap((left, top + 2, right, bottom - 2), line)


def test_the_baseline_is_at_one_on_the_scale_of_ratios() -> None:
    drawn = scene([point("a", 10.0), point("b", 20.0), BASELINE])
    (one,) = [tick.at for tick in drawn.ratios if tick.text == "1\N{MULTIPLICATION SIGN}"]
    assert one == drawn.baseline == dots(drawn)["two people"].at[0]


def test_without_a_baseline_there_are_no_ratios() -> None:
    drawn = scene([point("a", 10.0)])
    assert (drawn.baseline, drawn.ratios) == (None, ())


def test_two_policies_that_hold_still_can_be_drawn() -> None:
    drawn = scene([point("a", 120.0, None), point("b", 120.0, None)])
    assert drawn.front == ()
    assert all(dot.label for dot in drawn.dots)


def test_a_metric_of_which_less_is_better_has_the_lower_value_higher_up() -> None:
    axes = INTENT_METRICS[LEADING], second_axis(INTENT_METRICS)
    points = [point("quick", 20.0, 600.0), point("slow", 22.0, 900.0), point("failing", 60.0, None)]
    drawn = scene(points, axes=axes)
    quick, slow, failing = (dot.at[1] for dot in drawn.dots)
    assert quick < slow < failing
    assert drawn.axis_up == "Time to the right pose, ms · quicker →"
    assert drawn.dots[0].tip == "quick: RMSE 20.0 mm, settling 600 ms"
    assert any(note.text == "fails: no time to the right pose" for note in drawn.notes)
    heights = [tick.at for tick in sorted(drawn.up, key=lambda tick: float(tick.text))]
    assert heights == sorted(heights)
