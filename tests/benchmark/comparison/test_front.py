import numpy as np
import pytest
from colift.benchmark.comparison.comparison import Point, pareto_front

LEVEL = Point(rmse_mm=10.0, sparc=-3.0)
SMOOTH = Point(rmse_mm=20.0, sparc=-1.5)
STILL = Point(rmse_mm=120.0, sparc=None, missing=10)


def test_a_point_worse_in_both_is_not_on_the_front() -> None:
    worse = Point(rmse_mm=21.0, sparc=-1.6)
    assert pareto_front({"worse": worse, "smooth": SMOOTH, "level": LEVEL}) == ("level", "smooth")


def test_equal_points_are_both_on_it_and_a_tie_in_one_is_decided_by_the_other() -> None:
    assert pareto_front({"b": LEVEL, "a": LEVEL}) == ("a", "b")
    tie = Point(rmse_mm=10.0, sparc=-3.1)
    assert pareto_front({"tie": tie, "level": LEVEL}) == ("level",)


def test_a_robot_that_does_not_move_is_never_on_it_even_alone_or_the_most_level() -> None:
    assert pareto_front({"still": STILL}) == ()
    failing = Point(rmse_mm=250.0, sparc=-9.0)
    assert pareto_front({"still": STILL, "failing": failing}) == ("failing",)


def test_moving_only_when_it_is_easy_does_not_make_a_point_smooth() -> None:
    easy = Point(rmse_mm=20.0, sparc=-0.5, missing=1)
    assert not easy.dominates(SMOOTH)
    assert SMOOTH.dominates(easy)


@pytest.mark.parametrize("seed", range(10))
def test_of_many_points_it_is_those_that_none_dominates(seed: int) -> None:
    rng = np.random.default_rng(seed)
    points = {
        str(i): Point(rmse_mm=x, sparc=y) for i, (x, y) in enumerate(rng.uniform(-2, 0, (30, 2)))
    }
    front = pareto_front(points)
    for name, point in points.items():
        beaten = [
            other
            for other in points.values()
            if other.rmse_mm < point.rmse_mm and other.sparc > point.sparc
        ]
        assert (name in front) == (not beaten)
    smooth = [points[name].sparc for name in front]
    assert smooth == sorted(smooth)
