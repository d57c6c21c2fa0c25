"""Single lifts: their order, and the reasons of their failures."""

import pytest
from colift.benchmark.results.lifts import (
    ScoredLift,
    failures_by_reason,
    worst_first,
    worst_of_behaviours,
)


def lift(behaviour, rmse_mm, failure=None, seed=0, human_human_mm=2.0):
    return ScoredLift(
        behaviour=behaviour,
        subject="S1",
        seed=seed,
        rmse_mm=rmse_mm,
        human_human_mm=human_human_mm,
        failure=failure,
    )


def test_of_equal_lifts_the_last_is_worse():
    assert worst_first([2.0, 3.0, 1.0, 3.0]) == [3, 1, 0, 2]
    assert worst_first([]) == []


def test_each_behaviour_has_a_worst_lift_in_order_of_appearance():
    lifts = [
        lift("pause", 3.0),
        lift("smooth", 9.0),
        lift("pause", 5.0, seed=1),
        lift("pause", 5.0, seed=2),
    ]
    assert worst_of_behaviours(lifts) == [lifts[3], lifts[1]]
    assert worst_of_behaviours([]) == []


def test_a_reason_is_the_same_in_any_step():
    lifts = [
        lift("smooth", 250.0, "start: OSError: no file"),
        lift("smooth", 5.0),
        lift("pause", 90.0, "step 3: ValueError: no idea", seed=1),
        lift("pause", 80.0, "step 7: ValueError: no idea", seed=2),
    ]
    assert failures_by_reason(lifts) == [
        ("step 3: ValueError: no idea", lifts[2:]),
        ("start: OSError: no file", lifts[:1]),
    ]


def test_a_lift_has_a_name_and_a_ratio_to_two_people():
    assert lift("smooth", 5.0, seed=4).name == "smooth/S1 seed 4"
    assert lift("smooth", 5.0).ratio == pytest.approx(2.5)
    assert lift("smooth", 5.0, human_human_mm=None).ratio is None
