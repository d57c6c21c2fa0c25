import numpy as np
import pytest
from colift.agents.agent import FRAME
from colift.agents.estimators.minimum_jerk import profile
from colift.agents.humans.stroke import Submovement, replan, stroke, superpose


def with_start(motion, state=(0.0, 0.0, 0.0)):
    return np.hstack((np.reshape(state, (3, 1)), motion))


def test_minimum_jerk_is_the_published_polynomial():
    t = np.array([-0.5, 0.0, 0.25, 0.5, 0.75, 1.0, 2.0])
    assert profile(t) == pytest.approx([0, 0, 0.103515625, 0.5, 0.896484375, 1, 1])


def test_minimum_jerk_stroke_has_the_known_peaks():
    amplitude, duration = 0.2, 2.0
    height, velocity, acceleration = stroke(amplitude, duration)
    assert height[-1] == pytest.approx(amplitude, abs=1e-12)
    assert velocity.max() == pytest.approx(1.875 * amplitude / duration, rel=1e-9)
    assert np.abs(acceleration).max() == pytest.approx(5.7735 * amplitude / duration**2, rel=1e-3)


@pytest.mark.parametrize("skew", [0.3, 0.45, 0.5, 0.54, 0.7])
def test_skewed_stroke_is_fastest_at_the_asked_time(skew):
    velocity = stroke(0.2, 4.0, skew=skew)[1]
    assert (np.argmax(velocity) + 1) * FRAME / 4.0 == pytest.approx(skew, abs=FRAME / 4.0)


@pytest.mark.parametrize("skew", [0.3, 0.45, 0.5, 0.54, 0.7])
def test_skewed_stroke_starts_and_ends_at_rest_without_steps(skew):
    motion = with_start(stroke(-0.2, 2.0, skew=skew))
    assert motion[:, -1] == pytest.approx([-0.2, 0.0, 0.0], abs=1e-12)
    assert (np.diff(motion[0]) <= 0.0).all()
    steps = np.abs(np.diff(motion[2]))
    assert steps.max() < 0.15 * np.abs(motion[2]).max()


@pytest.mark.parametrize(
    "motion",
    [
        stroke(0.2, 2.0, skew=0.45),
        stroke(-0.2, 2.0, extra=[Submovement(start=0.3, duration=0.5, rise=-0.02)]),
        superpose([Submovement(start=0.1, duration=0.8, rise=0.1, skew=0.6)], 100),
        replan((0.0, 0.0, 0.0), 0.2, 1.5),
    ],
)
def test_velocity_and_acceleration_are_the_derivatives_of_the_displacement(motion):
    height, velocity, acceleration = with_start(motion)
    for rate, value in ((velocity, height), (acceleration, velocity)):
        integral = np.cumsum(0.5 * (rate[1:] + rate[:-1])) * FRAME
        assert integral == pytest.approx(value[1:], abs=2e-4)


def test_extra_submovements_do_not_change_where_a_stroke_ends():
    extra = [
        Submovement(start=0.2, duration=0.4, rise=0.03),
        Submovement(start=1.1, duration=0.6, rise=-0.02),
    ]
    plain, rich = stroke(0.2, 2.0), stroke(0.2, 2.0, extra=extra)
    assert rich[:, -1] == pytest.approx([0.2, 0.0, 0.0], abs=1e-12)
    assert np.abs(rich[0] - plain[0]).max() > 0.01


def test_a_submovement_moves_only_in_its_time():
    height = superpose([Submovement(start=0.5, duration=0.3, rise=0.05)], 120)[0]
    assert (height[:50] == 0.0).all()
    assert height[79:] == pytest.approx(0.05, abs=1e-12)


def test_replanning_goes_on_from_the_state_and_ends_at_rest():
    state = (0.1, 0.2, -0.4)
    motion = with_start(replan(state, 0.05, 1.2), state)
    assert motion[:, -1] == pytest.approx([0.05, 0.0, 0.0], abs=1e-12)
    height, velocity, acceleration = motion
    assert np.gradient(height, FRAME)[1:-1] == pytest.approx(velocity[1:-1], abs=5e-4)
    assert np.abs(np.diff(velocity)).max() < 1.5 * np.abs(acceleration).max() * FRAME
    assert velocity[1] == pytest.approx(0.2 - 0.4 * FRAME, abs=1e-3)


def test_replanning_from_rest_is_minimum_jerk():
    assert replan((0.0, 0.0, 0.0), 0.2, 2.0) == pytest.approx(stroke(0.2, 2.0), abs=1e-12)


def test_replanning_half_way_along_a_minimum_jerk_stroke_changes_nothing():
    whole = stroke(0.2, 2.0)
    rest = replan(whole[:, 79], 0.2, 1.2)
    assert rest == pytest.approx(whole[:, 80:], abs=1e-12)
