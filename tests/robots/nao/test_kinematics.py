from pathlib import Path

import numpy as np
import pybullet
import pytest
from colift.robots.nao import kinematics as arm
from colift.robots.nao.facts import ARM, JOINTS
from colift.robots.nao.urdf import arm_urdf

LIMITS = np.array([(JOINTS[name].lower, JOINTS[name].upper) for name in arm.ARM_JOINTS])
SPEEDS = np.array([JOINTS[name].speed for name in arm.ARM_JOINTS])
PATH = arm.arm_path()
JOINT_ROWS = np.array(PATH.joints)


def random_arms(count: int) -> np.ndarray:
    low, high = LIMITS[:5].T
    return np.random.default_rng(1).uniform(low, high, (count, 5))


def test_arm_stretched_forward_is_as_long_as_its_links() -> None:
    hand = arm.hand_position(np.zeros(5))
    np.testing.assert_allclose(hand, [0.105 + 0.05595 + 0.05775, 0.098 + 0.015, 0.1 - 0.01231])


def test_joints_are_as_far_apart_as_the_links_are_long() -> None:
    arms = random_arms(50)
    shoulder, roll, elbow, elbow_roll, wrist = np.moveaxis(arm.joint_positions(arms), -2, 0)
    np.testing.assert_allclose(shoulder, np.broadcast_to([0.0, 0.098, 0.1], (50, 3)), atol=1e-12)
    np.testing.assert_array_equal(shoulder, roll)
    np.testing.assert_array_equal(elbow, elbow_roll)
    for start, stop, length in (
        (shoulder, elbow, np.hypot(0.105, 0.015)),
        (elbow, wrist, 0.05595),
        (wrist, arm.hand_position(arms), np.hypot(0.05775, 0.01231)),
    ):
        np.testing.assert_allclose(np.linalg.norm(stop - start, axis=1), length, atol=1e-12)


def test_hand_goes_straight_up() -> None:
    hands = arm.hand_position(JOINT_ROWS[:, :5])
    assert np.ptp(PATH.heights) == pytest.approx(0.32)
    np.testing.assert_allclose(hands[:, 0], arm.GRIP_X, atol=1e-9)
    np.testing.assert_allclose(hands[:, 1], arm.GRIP_Y, atol=1e-9)
    np.testing.assert_allclose(hands[:, 2], arm.REST_Z + PATH.heights, atol=1e-9)


@pytest.mark.parametrize("height", [-0.03, 0.0, 0.12344, 0.29])
def test_lookup_is_within_half_a_row_of_the_height(height: float) -> None:
    hand = arm.hand_position(PATH.joint_angles(height)[:5])
    assert hand[2] - arm.REST_Z == pytest.approx(height, abs=2.6e-5)


def test_height_beyond_the_stroke_is_the_strokes_end() -> None:
    assert PATH.joint_angles(-0.5) == PATH.joint_angles(arm.STROKE[0])
    assert PATH.joint_angles(0.5) == PATH.joint_angles(arm.STROKE[1])


def test_lookup_gives_away_no_shared_memory() -> None:
    before = PATH.joint_angles(0.1)
    PATH.joint_angles(0.1)[0] = 9.0
    assert PATH.joint_angles(0.1) == before
    with pytest.raises(ValueError, match="read-only"):
        PATH.lever(0.1)[0] = 9.0


def test_right_arm_mirrors_the_left() -> None:
    np.testing.assert_allclose(JOINT_ROWS[:, 5:], JOINT_ROWS[:, :5] * arm.MIRROR)


def test_path_keeps_clear_of_the_joint_limits() -> None:
    room = np.minimum(JOINT_ROWS - LIMITS[:, 0], LIMITS[:, 1] - JOINT_ROWS)
    assert room.min() > 0.04


def test_path_has_no_jump() -> None:
    step = np.abs(JOINT_ROWS[10:] - JOINT_ROWS[:-10])  # 0.5 mm of height
    assert step.max() < 0.014


def test_joints_are_fast_enough_for_the_fastest_lift() -> None:
    rates = np.abs(np.gradient(JOINT_ROWS, PATH.heights, axis=0)) * 0.2
    assert (rates < SPEEDS).all()
    middle = (PATH.heights > 0.02) & (PATH.heights < 0.24)
    assert (rates[middle] < SPEEDS / 2.5).all()


@pytest.mark.parametrize("joint", range(5))
def test_lever_is_the_hands_rise_per_joint_angle(joint: int) -> None:
    arms = random_arms(50)
    step = np.zeros(5)
    step[joint] = 1e-6
    rise = (arm.hand_position(arms + step) - arm.hand_position(arms - step))[:, 2] / 2e-6
    np.testing.assert_allclose(arm.vertical_lever(arms)[:, joint], rise, atol=1e-9)


def test_tables_hold_lever_and_gravity_torque_of_their_height() -> None:
    left = PATH.joint_angles(0.07)[:5]
    np.testing.assert_allclose(PATH.lever(0.07), arm.vertical_lever(left), atol=1e-12)
    np.testing.assert_allclose(PATH.gravity_torque(0.07), arm.gravity_torque(left), atol=1e-12)


@pytest.mark.parametrize("side", ["L", "R"])
def test_gravity_torque_is_what_the_engine_must_hold(
    client: int, tmp_path: Path, side: str
) -> None:
    file = tmp_path / "arm.urdf"
    file.write_text(arm_urdf(side), encoding="utf-8")
    robot = pybullet.loadURDF(str(file), useFixedBase=True, physicsClientId=client)
    pybullet.setGravity(0, 0, -9.81, physicsClientId=client)
    mirror = np.ones(5) if side == "L" else np.array(arm.MIRROR)
    still = [0.0] * 5
    for left in (*random_arms(20), *JOINT_ROWS[::640, :5]):
        held = pybullet.calculateInverseDynamics(
            robot, (left * mirror).tolist(), still, still, physicsClientId=client
        )
        expected = arm.gravity_torque(left) * mirror
        np.testing.assert_allclose(-np.array(held), expected, atol=1e-4)


def test_shoulder_carries_the_arm_and_a_light_tables_share() -> None:
    shoulder = ARM.index("ShoulderPitch")
    load = PATH.gravity_torques + PATH.levers * (-0.15 * 9.81)
    assert (np.abs(load[:, shoulder]) < JOINTS["LShoulderPitch"].effort / 2).all()
