"""The robot's health, which is read before each lift: in simulated time."""

import re
from contextlib import closing

import pytest
from colift.agents.hardware.nao.health import findings, refuse_unless_well
from colift.agents.hardware.nao.naoqi import NaoqiArm
from colift.base.errors import InputError

from .conftest import Lab


@pytest.fixture
def robot():
    """A robot that has been there for a moment, with the laboratory that it is in."""
    with closing(Lab("smooth")) as lab:
        yield NaoqiArm(lab), lab


def test_a_robot_that_is_well_may_lift(robot):
    arm, _ = robot
    assert {each.name: each.state for each in findings(arm)} == {
        "temperatures": "38 °C or less in the arms (LShoulderPitch)",
        "battery": "90 %",
        "breathing": "off",
        "idle posture": "off",
    }
    refuse_unless_well(arm)


@pytest.mark.parametrize(
    ("fault", "told"),
    [
        ("hot@0", "temperatures: LElbowRoll 76 °C; let the robot rest until its arms are below 70"),
        ("hot@0:99:70", "temperatures: LElbowRoll 70 °C"),
        ("battery@0", "battery: 10 %; charge it to 20 % or more"),
        ("breathing@0", "breathing: on in LArm, RArm; switch it off: ALMotion.setBreathEnabled("),
        ("idle-posture@0", "idle posture: on in LArm, RArm; switch it off: "),
    ],
)
def test_a_robot_that_is_not_well_is_refused_with_the_cure(robot, fault, told):
    arm, lab = robot
    lab.request(fault)
    lab.wait_until(lab.now() + 0.02)
    with pytest.raises(InputError, match=re.escape(f"the robot must not lift: {told}")):
        refuse_unless_well(arm)
    lab._laboratory._faults.clear()
    lab.wait_until(lab.now() + 0.02)
    refuse_unless_well(arm)


@pytest.mark.parametrize("fault", ["hot@0:99:69", "battery@0:99:20"])
def test_what_is_nearly_too_much_is_allowed(robot, fault):
    arm, lab = robot
    lab.request(fault)
    lab.wait_until(lab.now() + 0.02)
    refuse_unless_well(arm)


@pytest.mark.parametrize("value", [None, "warm", float("nan")])
def test_a_temperature_that_is_not_known_is_not_believed(robot, value):
    arm, lab = robot
    key = "Device/SubDeviceList/RElbowYaw/Temperature/Sensor/Value"
    lab.call("ALMemory", "insertData", key, value)
    with pytest.raises(InputError, match="temperatures: unknown: RElbowYaw"):
        refuse_unless_well(arm)


def test_a_robot_that_breathes_moves_its_arms_until_it_is_commanded(robot):
    arm, lab = robot
    lab.request("breathing@0:99:0.05")
    lab.wait_until(lab.now() + 1.0)
    assert arm.state().astray > 0.02
