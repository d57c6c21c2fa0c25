import numpy as np
import pytest
from colift.benchmark.comparison.front import FrontPoint, exact, pareto_front
from colift.benchmark.episode.metric import second_axis
from colift.benchmark.statistics import Estimate
from colift.benchmark.tasks.intent.table import INTENT_METRICS
from colift.benchmark.tasks.level.table import LEVEL_METRICS

SPARC = second_axis(LEVEL_METRICS)


def point(name: str, rmse_mm: float, sparc: float | None, missing: int = 0) -> FrontPoint:
    rmse = Estimate(mean=rmse_mm, ci95=(rmse_mm, rmse_mm))
    return FrontPoint(name=name, rmse_mm=rmse, second=exact(sparc), missing=missing)


def front(*points: FrontPoint) -> list[str]:
    return [each.name for each in pareto_front(points, SPARC)]


LEVEL = point("level", 10.0, -3.0)
SMOOTH = point("smooth", 20.0, -1.5)
STILL = point("still", 120.0, None, missing=10)


def test_a_point_worse_in_both_is_not_on_the_front() -> None:
    assert front(point("worse", 21.0, -1.6), SMOOTH, LEVEL) == ["level", "smooth"]


def test_equal_points_are_both_on_it_and_a_tie_in_one_is_decided_by_the_other() -> None:
    assert front(point("b", 10.0, -3.0), point("a", 10.0, -3.0)) == ["a", "b"]
    assert front(point("tie", 10.0, -3.1), LEVEL) == ["level"]


def test_a_robot_that_does_not_move_is_never_on_it_even_alone_or_the_most_level() -> None:
    assert front(STILL) == []
    assert front(STILL, point("failing", 250.0, -9.0)) == ["failing"]


def test_moving_only_when_it_is_easy_does_not_make_a_point_smooth() -> None:
    easy = point("easy", 20.0, -0.5, missing=1)
    assert not dominates(easy, SMOOTH)
    assert dominates(SMOOTH, easy)


def test_a_reference_neither_is_on_it_nor_keeps_a_policy_off_it() -> None:
    rmse = Estimate(mean=0.1, ci95=(0.0, 0.2))
    assert front(
        LEVEL, FrontPoint(name="oracle", rmse_mm=rmse, second=exact(-1.0), kind="reference")
    ) == ["level"]


def dominates(one: FrontPoint, other: FrontPoint) -> bool:
    """Return whether a point is at least as good in both, and better in one."""
    mine, theirs = ((-each.rmse_mm.mean, each.merit(SPARC)) for each in (one, other))
    return mine[0] >= theirs[0] and mine[1] >= theirs[1] and mine != theirs


@pytest.mark.parametrize("seed", range(10))
def test_of_many_points_it_is_those_that_none_dominates(seed: int) -> None:
    rng = np.random.default_rng(seed)
    points = [point(str(i), x, y) for i, (x, y) in enumerate(rng.uniform(-2, 0, (30, 2)).round(1))]
    best = pareto_front(points, SPARC)
    for one in points:
        assert (one in best) == (not any(dominates(other, one) for other in points))
    smooth = [each.second.mean for each in best if each.second]
    assert len(smooth) == len(best)
    assert smooth == sorted(smooth)


def test_where_less_is_better_the_quicker_of_two_equal_errors_is_on_the_front() -> None:
    points = point("slow", 20.0, 900.0), point("quick", 20.0, 600.0), point("worst", 30.0, 950.0)
    metric = second_axis(INTENT_METRICS)
    assert metric.better == "less"
    assert [each.name for each in pareto_front(points, metric)] == ["quick"]
