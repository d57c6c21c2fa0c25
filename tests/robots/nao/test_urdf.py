from collections.abc import Callable
from pathlib import Path

import numpy as np
import pybullet
import pytest
from colift.robots.nao.facts import ARM, JOINTS
from colift.robots.nao.kinematics import STROKE, arm_path, hand_position
from colift.robots.nao.urdf import arm_urdf, nao_urdf_path

Load = Callable[..., int]


@pytest.fixture
def load(client: int, tmp_path: Path) -> Load:
    """Return a loader of URDF text."""

    def load_text(text: str) -> int:
        file = tmp_path / "robot.urdf"
        file.write_text(text, encoding="utf-8")
        flags = pybullet.URDF_USE_INERTIA_FROM_FILE
        number: int = pybullet.loadURDF(
            str(file), useFixedBase=True, flags=flags, physicsClientId=client
        )
        return number

    return load_text


def names(robot: int, client: int) -> list[str]:
    count = pybullet.getNumJoints(robot, client)
    return [pybullet.getJointInfo(robot, i, client)[1].decode() for i in range(count)]


def arm_joints(side: str) -> list[str]:
    return [f"{side}{name}" for name in ARM]


def arm_angles(side: str, height: float) -> list[float]:
    both = arm_path().joint_angles(height)
    return both[:5] if side == "L" else both[5:]


@pytest.mark.parametrize("side", ["L", "R"])
def test_an_arm_is_a_chain_of_its_five_joints_without_shapes(
    load: Load, client: int, side: str
) -> None:
    robot = load(arm_urdf(side))
    assert names(robot, client) == arm_joints(side)
    assert not pybullet.getVisualShapeData(robot, physicsClientId=client)
    for index, name in enumerate(names(robot, client)):
        info = pybullet.getJointInfo(robot, index, client)
        joint = JOINTS[name]
        assert info[8:12] == pytest.approx((joint.lower, joint.upper, joint.effort, joint.speed))


@pytest.mark.parametrize("side", ["L", "R"])
def test_welding_the_hand_changes_no_inertia(load: Load, client: int, side: str) -> None:
    robots = load(nao_urdf_path().read_text(encoding="utf-8")), load(arm_urdf(side))
    angles = dict(zip(arm_joints(side), arm_angles(side, 0.2), strict=True))
    matrices = []
    for robot in robots:
        found = names(robot, client)
        pose = [angles.get(name, 0.0) for name in found]
        matrix = np.array(pybullet.calculateMassMatrix(robot, pose, physicsClientId=client))
        arm = [found.index(name) for name in arm_joints(side)]
        matrices.append(matrix[np.ix_(arm, arm)])
    assert np.diag(matrices[0]).min() > 1e-5
    np.testing.assert_allclose(matrices[1], matrices[0], atol=1e-8)


@pytest.mark.parametrize(("side", "sign"), [("L", 1), ("R", -1)])
def test_hands_are_where_the_kinematics_say(load: Load, client: int, side: str, sign: int) -> None:
    robot = load(arm_urdf(side))
    mirrored = np.multiply(JOINTS["LHand"].origin, (1, sign, 1))
    for height in np.linspace(*STROKE, 33):
        for index, angle in enumerate(arm_angles(side, height)):
            pybullet.resetJointState(robot, index, angle, physicsClientId=client)
        state = pybullet.getLinkState(
            robot, 4, computeForwardKinematics=True, physicsClientId=client
        )
        hand, _ = pybullet.multiplyTransforms(state[4], state[5], mirrored, (0, 0, 0, 1))
        left = hand_position(arm_angles("L", height))
        assert hand == pytest.approx(left * (1, sign, 1), abs=1e-5)
