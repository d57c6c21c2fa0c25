"""The limits of the hands, for any numbers."""

import math

import pytest
from colift.agents.hardware.ports import ArmState, HandLimits
from colift.agents.hardware.safety import hand_limits, limited, motor_fault, next_command
from colift.base.errors import InputError
from colift.robots.nao.facts import JOINTS
from colift.robots.nao.kinematics import ARM_JOINTS
from hypothesis import given
from hypothesis import strategies as st

LIMITS = HandLimits(low=-0.03, high=0.29, speed=0.4, tilt=0.14)
OWN = {name: (JOINTS[name].lower, JOINTS[name].upper) for name in ARM_JOINTS}

anything = st.floats(allow_nan=True, allow_infinity=True)
inside = st.floats(LIMITS.low, LIMITS.high)
durations = st.floats(0.02, 0.5)


@given(anything, inside, durations)
def test_a_command_is_within_heights_and_reach(wanted, present, duration):
    height = limited(wanted, present, duration, LIMITS)
    assert LIMITS.low <= height <= LIMITS.high
    assert abs(height - present) <= LIMITS.speed * duration + 1e-12


@given(anything, inside, inside, durations)
def test_the_next_command_is_within_reach_of_where_the_robot_is(
    wanted, command, set_point, duration
):
    height = next_command(wanted, command, set_point, duration, LIMITS)
    assert LIMITS.low <= height <= LIMITS.high
    assert abs(height - set_point) <= LIMITS.speed * duration + 1e-12


@given(st.floats(-1.0, 1.0), durations)
def test_the_way_back_from_outside_is_no_faster(present, duration):
    height = limited(0.1, present, duration, LIMITS)
    assert abs(height - present) <= LIMITS.speed * duration + 1e-12


def test_what_is_no_number_means_to_stay():
    assert limited(math.nan, 0.1, 0.1, LIMITS) == 0.1
    assert limited(math.inf, 0.1, 0.1, LIMITS) == 0.1


def test_the_whole_stroke_is_within_a_real_robots_limits():
    limits = hand_limits(OWN)
    assert (limits.low, limits.high) == pytest.approx((-0.03, 0.29))
    assert limits.speed == 0.4


def test_a_robot_whose_elbows_bend_less_lifts_less():
    less = {**OWN, "LElbowRoll": (-1.4, -0.03)}
    limits = hand_limits(less)
    assert limits.low == pytest.approx(-0.03)
    assert 0.05 < limits.high < 0.1


def test_a_robot_that_cannot_hold_the_table_or_is_no_h25_is_refused():
    with pytest.raises(InputError, match=r"out of the robot's reach: LShoulderPitch"):
        hand_limits({**OWN, "LShoulderPitch": (-0.1, 0.1)})
    with pytest.raises(InputError, match=r"no limits of LWristYaw.*H25"):
        hand_limits({name: row for name, row in OWN.items() if name != "LWristYaw"})


@pytest.mark.parametrize(
    ("state", "told"),
    [
        (ArmState(0.1, 0.11, 1.0), None),
        (ArmState(0.1, 0.11, 0.2), "stiffness 0.20"),
        (ArmState(0.1, 0.16, 1.0), "commanded to 0.160"),
        (ArmState(0.1, math.nan, 1.0), "nan"),
        (ArmState(0.1, 0.1, math.nan), "nan"),
    ],
)
def test_motors_that_do_not_do_what_they_are_told_are_noticed(state, told):
    found = motor_fault(state)
    assert (found is None) if told is None else (told in found)
