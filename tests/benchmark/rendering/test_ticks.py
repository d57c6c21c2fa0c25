import pytest
from colift.benchmark.rendering.ticks import far_limit, round_step, round_ticks


@pytest.mark.parametrize(
    ("breadth", "most", "step"),
    [(10.0, 5, 2.0), (10.1, 5, 5.0), (0.9, 9, 0.1), (1.0, 1, 1.0), (730.0, 4, 200.0)],
)
def test_a_step_is_the_least_round_one_that_is_enough(
    breadth: float, most: int, step: float
) -> None:
    assert round_step(breadth, most) == pytest.approx(step)


def test_ticks_are_the_multiples_within_both_ends() -> None:
    assert round_ticks(-2.35, -1.58, 5) == (-2.2, -2.0, -1.8, -1.6)
    assert round_ticks(0.0, 10.0, 5) == (0.0, 2.0, 4.0, 6.0, 8.0, 10.0)
    assert round_ticks(0.1, 0.35, 5) == (0.1, 0.15, 0.2, 0.25, 0.3, 0.35)


def test_a_value_is_far_off_from_three_times_the_median_on() -> None:
    assert far_limit([1.0, 2.0, 90.0]) == 6.0
    assert far_limit([]) == 0.0
