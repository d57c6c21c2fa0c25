from collections.abc import Callable
from pathlib import Path
from xml.etree import ElementTree as ET

import numpy as np
import pybullet
import pytest
from colift.robots.nao.facts import JOINTS, LINKS
from colift.robots.nao.kinematics import ARM_JOINTS, STROKE, arm_path, hand_position
from colift.robots.nao.urdf import arms_only_urdf, nao_urdf_path

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


ARM_BODIES = tuple(
    f"{side}{body}"
    for side in "LRlr"
    for body in ("Shoulder", "Bicep", "Elbow", "ForeArm", "_wrist", "_gripper", "Finger", "Thumb")
)


def angle(posture: dict[str, float], name: str) -> float:
    """Return a joint's angle in a posture, those that follow another included."""
    return posture.get(JOINTS[name].mimic or name, 0.0) * JOINTS[name].mimic_ratio


def names(robot: int, client: int) -> list[str]:
    count = pybullet.getNumJoints(robot, client)
    return [pybullet.getJointInfo(robot, i, client)[1].decode() for i in range(count)]


@pytest.mark.parametrize("shapes", [True, False])
def test_arms_only_moves_in_the_ten_arm_joints(load: Load, client: int, shapes: bool) -> None:
    robot = load(arms_only_urdf(shapes=shapes))
    assert sorted(names(robot, client)) == sorted(ARM_JOINTS)
    assert bool(pybullet.getVisualShapeData(robot, physicsClientId=client)) is shapes
    for index, name in enumerate(names(robot, client)):
        info = pybullet.getJointInfo(robot, index, client)
        joint = JOINTS[name]
        assert info[8:12] == pytest.approx((joint.lower, joint.upper, joint.effort, joint.speed))


def test_welding_changes_no_arms_inertia(load: Load, client: int) -> None:
    posture = {"LHand": 0.8, "RHand": 0.3}
    whole = load(nao_urdf_path().read_text(encoding="utf-8"))
    welded = load(arms_only_urdf(posture, shapes=False))
    angles = dict(zip(ARM_JOINTS, arm_path().joint_angles(0.2), strict=True))
    matrices = []
    for robot in (whole, welded):
        found = names(robot, client)
        pose = [angles.get(name, angle(posture, name)) for name in found]
        matrix = np.array(pybullet.calculateMassMatrix(robot, pose, physicsClientId=client))
        arms = [found.index(name) for name in ARM_JOINTS]
        matrices.append(matrix[np.ix_(arms, arms)])
    assert np.diag(matrices[0]).min() > 1e-5
    np.testing.assert_allclose(matrices[1], matrices[0], atol=1e-8)


def test_welded_hands_are_where_the_kinematics_say(load: Load, client: int) -> None:
    robot = load(arms_only_urdf(shapes=False))
    index = {name: i for i, name in enumerate(names(robot, client))}
    for height in np.linspace(*STROKE, 33):
        angles = arm_path().joint_angles(height)
        for name, value in zip(ARM_JOINTS, angles, strict=True):
            pybullet.resetJointState(robot, index[name], value, physicsClientId=client)
        left = hand_position(angles[:5])
        for wrist, side in (("LWristYaw", 1), ("RWristYaw", -1)):
            state = pybullet.getLinkState(
                robot, index[wrist], computeForwardKinematics=True, physicsClientId=client
            )
            mirrored = np.multiply(JOINTS["LHand"].origin, (1, side, 1))
            hand, _ = pybullet.multiplyTransforms(state[4], state[5], mirrored, (0, 0, 0, 1))
            assert hand == pytest.approx(left * (1, side, 1), abs=1e-5)


def test_welded_posture_balances_like_the_whole_robots(load: Load, client: int) -> None:
    posture = {"HeadYaw": 0.7, "HeadPitch": 0.4, "LHipYawPitch": -0.4, "RKneePitch": 1.1}
    whole = load(nao_urdf_path().read_text(encoding="utf-8"))
    for index, name in enumerate(names(whole, client)):
        pybullet.resetJointState(whole, index, angle(posture, name), physicsClientId=client)
    mass, moment = LINKS["torso"].mass, LINKS["torso"].mass * np.array(LINKS["torso"].com)
    for index, name in enumerate(names(whole, client)):
        link = LINKS[JOINTS[name].child]
        if not link.name.startswith(ARM_BODIES):
            state = pybullet.getLinkState(
                whole, index, computeForwardKinematics=True, physicsClientId=client
            )
            base, _ = pybullet.getBasePositionAndOrientation(whole, client)
            torso = np.array(base) - LINKS["torso"].com
            mass += link.mass
            moment = moment + link.mass * (np.array(state[0]) - torso)
    inertial = ET.fromstring(arms_only_urdf(posture)).find("link[@name='torso']/inertial")
    assert inertial is not None
    numbers = {part.tag: part.attrib for part in inertial}
    assert float(numbers["mass"]["value"]) == pytest.approx(mass)
    com = [float(value) for value in numbers["origin"]["xyz"].split()]
    assert com == pytest.approx(moment / mass, abs=1e-6)


def test_arms_only_text_has_no_shapes_when_told_so() -> None:
    robot = ET.fromstring(arms_only_urdf(shapes=False))
    assert robot.find(".//visual") is None
    assert robot.find(".//collision") is None


@pytest.mark.parametrize("name", ["LShoulderPitch", "LFinger11", "RHipYawPitch", "Tail"])
def test_joint_that_cannot_be_posed_is_refused(name: str) -> None:
    with pytest.raises(ValueError, match=f"{name}.*HeadYaw, HeadPitch"):
        arms_only_urdf({name: 0.1})


@pytest.mark.parametrize("yaw", [2.2, float("nan")])
def test_angle_outside_the_limits_is_refused(yaw: float) -> None:
    with pytest.raises(ValueError, match=rf"HeadYaw = {yaw} rad.*-2\.08567 to 2\.08567"):
        arms_only_urdf({"HeadYaw": yaw})
