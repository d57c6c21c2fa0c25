"""The filters of the ball and of the person's aim."""

import numpy as np
import pytest
from colift.agents.tasks.ball import aim_filter
from colift.agents.tasks.ball.aim_filter import PARTS, AimFilter, wanted_difference
from colift.agents.tasks.ball.ball_filter import BallFilter
from colift.agents.tasks.ball.facts import BALL_WEIGHT, LENGTH, PULL, WRIST, meant_by_wrists

PERIOD = 0.1


def rolled(difference, steps=20):
    """Return the places of a ball from rest under a height difference, each period."""
    time = PERIOD * np.arange(1, steps + 1)
    return -PULL * difference * time**2 / 2


def test_the_ball_filter_follows_a_ball_that_it_is_told_the_inclination_of():
    ball = BallFilter()
    ball.reset()
    places = rolled(0.02)
    for place in places:
        ball.update(float(place), 0.02, PERIOD)
    assert ball.place == pytest.approx(places[-1], abs=1e-9)
    assert ball.speed == pytest.approx(-PULL * 0.02 * 2.0, rel=1e-9)
    later, speed = ball.ahead([0.02] * 10, 0.01)
    assert later == pytest.approx(rolled(0.02, 21)[-1], rel=1e-9)
    assert speed == pytest.approx(-PULL * 0.02 * 2.1, rel=1e-9)


def test_the_ball_filter_finds_the_speed_of_a_ball_that_it_is_told_nothing_of():
    ball = BallFilter()
    ball.reset()
    for place in rolled(0.01):
        ball.update(float(place), 0.0, PERIOD)
    assert ball.speed == pytest.approx(-PULL * 0.01 * 2.0, rel=0.1)


def test_the_force_of_resting_hands_means_level_wrists():
    assert meant_by_wrists(BALL_WEIGHT / 2, 0.0, 0.0) == pytest.approx(0.0)
    assert meant_by_wrists(BALL_WEIGHT, 0.0, LENGTH / 2) == pytest.approx(0.0)


def test_wrists_that_press_the_far_end_down_mean_it_lower():
    """1 N more at the far end is a torque of 0.8 Nm, which displaces the wrists by L / K of it."""
    meant = meant_by_wrists(BALL_WEIGHT / 2 + 1.0, 0.0, 0.0)
    assert meant == pytest.approx(-LENGTH * LENGTH / WRIST)


def judged(part, steps=120):
    """Return the filter and its aims after a person of the assumed law, whose ball swings."""
    aim = AimFilter()
    aim.reset()
    found = []
    for step, error in enumerate(np.random.default_rng(1).normal(0.0, 0.004, steps)):
        time = step * PERIOD
        place, speed = 0.1 * np.sin(2 * time), 0.2 * np.cos(2 * time)
        meant = part * wanted_difference(place, speed, 0.08) + error
        aim.update(place, speed, meant, PERIOD)
        found.append(aim.aim)
    return aim, np.array(found)


@pytest.mark.parametrize("part", [0.2, 0.5, 0.9])
def test_the_aim_of_a_person_whose_part_is_known_is_found(part, monkeypatch):
    monkeypatch.setattr(aim_filter, "PARTS", np.array([part]))
    _, found = judged(part)
    assert found[60:].mean() == pytest.approx(0.08, abs=0.005)


def test_wrists_that_show_much_are_told_from_those_that_show_little():
    little, half, much = (judged(part)[0].part for part in (0.2, 0.5, 0.9))
    assert little < 0.6 * half < 0.6 * much


def test_of_an_unknown_part_the_aim_has_the_right_side_at_least():
    for part in (0.2, 0.5, 0.9):
        assert judged(part)[1][20:].min() > 0.0


def test_before_anything_is_felt_all_parts_are_equally_likely():
    aim = AimFilter()
    aim.reset()
    assert aim.weights == pytest.approx(np.full(len(PARTS), 1 / len(PARTS)))
    assert aim.aim == 0.0
