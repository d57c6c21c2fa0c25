"""The model of a robot's picture, in an engine of its own."""

from colift.benchmark.robots.robot import Robot
from colift.benchmark.world.bullet import pybullet, silent


def load_model(client: int, robot: Robot) -> tuple[int, dict[str, int]]:
    """Load the model of a robot, and return its body and the indices of its joints by name.

    A model for pictures alone has no masses, of which PyBullet would warn.
    """
    with silent():
        body: int = pybullet.loadURDF(
            str(robot.model()), robot.place, useFixedBase=True, physicsClientId=client
        )
    joints = range(pybullet.getNumJoints(body, physicsClientId=client))
    infos = (pybullet.getJointInfo(body, joint, physicsClientId=client) for joint in joints)
    return body, {info[1].decode(): info[0] for info in infos}
