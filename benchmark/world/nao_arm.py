"""One arm of the NAO in the engine."""

from typing import Final

from colift.benchmark.world.bullet import pybullet
from colift.benchmark.world.engine import Vector, load_urdf_text, pin
from colift.robots.nao.facts import ARM, HAND_OFFSET_X, HAND_OFFSET_Z, JOINTS
from colift.robots.nao.urdf import arm_urdf

_HAND: Final = (HAND_OFFSET_X, 0.0, -HAND_OFFSET_Z)
"""The hand point in the frame of the last arm joint [m]; it has no sideways offset."""

_ZEROS: Final = [0.0] * len(ARM)
_ONES: Final = [1.0] * len(ARM)


class NaoArm:
    """One arm on a torso that does not move: a separate body with five joints.

    Parameters
    ----------
    client
        The engine.
    side
        ``L`` or ``R``.
    angles
        The angles to begin with [rad], in the order of :data:`~.facts.ARM`.
    arms
        Number of equal arms that it stands for: a factor of masses, inertias and torques.
    """

    def __init__(self, client: int, side: str, angles: list[float], arms: int = 1) -> None:
        self._client = client
        self._body = load_urdf_text(client, arm_urdf(side, arms), (0, 0, 0))
        self._joints = list(range(len(ARM)))  # A chain: the engine's order is that of ``ARM``.
        self._wrist = self._joints[-1]
        self.efforts = [arms * JOINTS[f"{side}{name}"].effort for name in ARM]
        for joint, angle in zip(self._joints, angles, strict=True):
            pybullet.resetJointState(self._body, joint, angle, physicsClientId=client)

    def grip(self, table: int, link: int, point: Vector) -> None:
        """Pin the hand to a link of the table at ``point`` (world frame) [m]."""
        pin(self._client, (self._body, self._wrist), (table, link), point)

    def drive(self, angles: list[float], gains: list[float], efforts: list[float]) -> None:
        """Set the motors, which keep their settings: angles [rad], gains, largest torques [N m]."""
        pybullet.setJointMotorControlArray(
            self._body,
            self._joints,
            pybullet.POSITION_CONTROL,
            angles,
            _ZEROS,
            efforts,
            gains,
            _ONES,
            self._client,
        )

    def angles(self) -> list[float]:
        """Return the joints' angles by the encoders [rad]."""
        states = pybullet.getJointStates(self._body, self._joints, physicsClientId=self._client)
        return [state[0] for state in states]

    def hand_height(self) -> float:
        """Return the height of the hand [m] by forward kinematics of the joints."""
        state = pybullet.getLinkState(self._body, self._wrist, 0, 1, self._client)
        x, y, z, w = state[5]
        ahead, up = 2 * (x * z - y * w), 1 - 2 * (x * x + y * y)
        height: float = state[4][2] + ahead * _HAND[0] + up * _HAND[2]
        return height
