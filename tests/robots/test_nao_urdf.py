import numpy as np
import pybullet
import pytest
from colift.robots.nao import facts as nao
from colift.robots.nao.urdf import nao_urdf_path
from colift.robots.nao.urdf_writer import nao_urdf


@pytest.fixture
def robot(client: int) -> int:
    number: int = pybullet.loadURDF(
        str(nao_urdf_path()),
        [0.0, 0.0, nao.TORSO_HEIGHT],
        useFixedBase=True,
        flags=pybullet.URDF_USE_INERTIA_FROM_FILE,
        physicsClientId=client,
    )
    return number


def indices(robot: int, client: int) -> dict[str, int]:
    count = pybullet.getNumJoints(robot, client)
    infos = [pybullet.getJointInfo(robot, i, client) for i in range(count)]
    return {info[1].decode(): info[0] for info in infos}


def frame(robot: int, joint: str, client: int) -> np.ndarray:
    """Return where a joint's frame is in the world [m]."""
    state = pybullet.getLinkState(robot, indices(robot, client)[joint], physicsClientId=client)
    return np.array(state[4])


def test_shipped_file_is_what_the_writer_writes() -> None:
    assert nao_urdf_path().read_text(encoding="utf-8") == nao_urdf()


def test_engine_reads_every_joint_as_published(robot: int, client: int) -> None:
    found = indices(robot, client)
    assert found.keys() == nao.JOINTS.keys()
    for name, index in found.items():
        info = pybullet.getJointInfo(robot, index, client)
        joint = nao.JOINTS[name]
        assert info[2] == pybullet.JOINT_REVOLUTE
        if "Hand" not in joint.mimic:  # fingers have no limits of their own
            limits = (joint.lower, joint.upper, joint.effort, joint.speed)
            assert info[8:12] == pytest.approx(limits)
        assert info[12].decode() == joint.child
        # The engine gives the axis in the principal axes of the child's inertia.
        principal = pybullet.getDynamicsInfo(robot, index, client)[4]
        axis, _ = pybullet.multiplyTransforms((0, 0, 0), principal, info[13], (0, 0, 0, 1))
        expected = np.array(joint.axis) / np.linalg.norm(joint.axis)
        assert axis == pytest.approx(expected, abs=1e-6)


def test_engine_weighs_every_link_as_published(robot: int, client: int) -> None:
    bodies = {-1: "torso"} | {
        index: nao.JOINTS[name].child for name, index in indices(robot, client).items()
    }
    total = 0.0
    for index, name in bodies.items():
        dynamics = pybullet.getDynamicsInfo(robot, index, client)
        link = nao.LINKS[name]
        xx, xy, xz, yy, yz, zz = link.inertia
        moments = np.linalg.eigvalsh([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])
        if index >= 0:  # the engine reports no mass for a base that cannot move
            total += dynamics[0]
            assert dynamics[0] == pytest.approx(link.mass)
            assert sorted(dynamics[2]) == pytest.approx(moments, rel=1e-4)
        assert dynamics[3] == pytest.approx(link.com, abs=1e-9)
    assert total == pytest.approx(5.3054 - nao.LINKS["torso"].mass, abs=1e-4)


@pytest.mark.parametrize(
    ("start", "end", "length"),
    [
        ("LShoulderPitch", "LElbowYaw", np.hypot(nao.UPPER_ARM_LENGTH, nao.ELBOW_OFFSET_Y)),
        ("RElbowYaw", "RWristYaw", nao.LOWER_ARM_LENGTH),
        ("LWristYaw", "LHand", np.hypot(nao.HAND_OFFSET_X, nao.HAND_OFFSET_Z)),
        ("RHipPitch", "RKneePitch", nao.THIGH_LENGTH),
        ("LKneePitch", "LAnklePitch", nao.TIBIA_LENGTH),
        ("LShoulderPitch", "RShoulderPitch", 2 * nao.SHOULDER_OFFSET_Y),
        ("LHipYawPitch", "RHipYawPitch", 2 * nao.HIP_OFFSET_Y),
    ],
)
def test_joints_are_the_documented_lengths_apart(
    robot: int, client: int, start: str, end: str, length: float
) -> None:
    between = frame(robot, end, client) - frame(robot, start, client)
    assert np.linalg.norm(between) == pytest.approx(length, abs=1e-6)


def test_it_stands_on_the_floor_head_up(robot: int, client: int) -> None:
    (crown,) = pybullet.rayTest((0.0, 0.0, 1.0), (0.0, 0.0, 0.0), physicsClientId=client)
    (sole,) = pybullet.rayTest((0.02, 0.05, -1.0), (0.02, 0.05, 1.0), physicsClientId=client)
    assert (crown[0], sole[0]) == (robot, robot)
    assert crown[3][2] == pytest.approx(0.574, abs=0.003)
    assert sole[3][2] == pytest.approx(0.0, abs=0.001)


def test_it_is_seen_without_mesh_files(robot: int, client: int) -> None:
    shapes = pybullet.getVisualShapeData(robot, physicsClientId=client)
    solids = {pybullet.GEOM_BOX, pybullet.GEOM_CYLINDER, pybullet.GEOM_SPHERE}
    assert {shape[2] for shape in shapes} == solids
    assert all(shape[4] == b"" for shape in shapes)
