"""The emulated ALMotion: names, limits, ticks; in this process and over libqi."""

import pytest
from colift.agents.hardware.nao.session import NaoqiSession
from colift.agents.hardware.ports import RobotLostError
from colift.benchmark.hardware.joint_motion import (
    BODY,
    TICK,
    JointMotion,
    MotionError,
    joint_names,
    per_joint,
)
from colift.robots.nao.facts import JOINTS


def test_names_chains_and_body_are_naoqis():
    assert len(joint_names("Body")) == len(BODY) == 26
    assert joint_names("LArm") == [
        "LShoulderPitch",
        "LShoulderRoll",
        "LElbowYaw",
        "LElbowRoll",
        "LWristYaw",
        "LHand",
    ]
    assert joint_names(["HeadYaw", "RArm"])[:2] == ["HeadYaw", "RShoulderPitch"]
    with pytest.raises(MotionError, match="'LTail' is not a joint"):
        joint_names("LTail")


@pytest.mark.parametrize("value", [[1.0], "up", [None, 1.0]])
def test_as_many_numbers_as_joints_are_needed(value):
    with pytest.raises(MotionError, match="angles"):
        per_joint(value, 2, "angles")


def test_a_joint_moves_at_its_share_of_its_greatest_speed_tick_by_tick():
    motion = JointMotion({})
    motion.set_angles(["HeadYaw"], [1.0], 0.1)
    for _ in range(5):
        motion.tick()
    assert motion.set_points(["HeadYaw"]) == pytest.approx(
        [5 * TICK * 0.1 * JOINTS["HeadYaw"].speed]
    )
    motion.kill()
    there = motion.set_points(["HeadYaw"])
    motion.tick()
    assert motion.set_points(["HeadYaw"]) == there


def test_angles_are_clipped_to_the_limits():
    motion = JointMotion({})
    motion.set_angles(["LElbowRoll"], [2.0], 1.0)
    for _ in range(100):
        motion.tick()
    assert motion.set_points(["LElbowRoll"]) == [JOINTS["LElbowRoll"].upper]


@pytest.mark.parametrize("fraction", [0.0, -0.1, 1.01])
def test_a_fraction_out_of_range_is_refused(fraction):
    with pytest.raises(MotionError, match="fractionMaxSpeed"):
        JointMotion({}).set_angles(["HeadYaw"], [0.1], fraction)


def test_stiffness_takes_its_time():
    motion = JointMotion({})
    motion.set_stiffness(["HeadYaw"], [0.0], 1.0)
    for _ in range(25):
        motion.tick()
    assert motion.stiffness(["HeadYaw"]) == pytest.approx([0.5])
    assert motion.stiffening(["HeadYaw"])
    assert not motion.moving(["HeadYaw"])


def test_the_server_answers_over_libqi_as_naoqi_does(emulate):
    session = NaoqiSession(emulate().url)
    (row,) = session.call("ALMotion", "getLimits", "LElbowRoll", within=2.0)
    joint = JOINTS["LElbowRoll"]
    assert row == pytest.approx([joint.lower, joint.upper, joint.speed, joint.effort])
    assert len(session.call("ALMotion", "getAngles", "Body", True, within=2.0)) == 26
    for method, arguments, told in (
        ("setAngles", ("LTail", 0.1, 0.1), "'LTail' is not a joint"),
        ("setAngles", ("HeadYaw", [0.1, 0.2], 0.1), r"1 joint\(s\) need 1 angles"),
        ("setAngles", ("HeadYaw", 0.1, 2.0), "fractionMaxSpeed"),
        ("openHand", ("LHand",), "openHand"),
    ):
        with pytest.raises(RobotLostError, match=told):
            session.call("ALMotion", method, *arguments, within=2.0)
    assert session.has("ALSystem")
    assert not session.has("ALVideoDevice")
    session.close()
