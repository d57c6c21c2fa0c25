"""The NAO's two arms at the far end of the table."""

import math
from dataclasses import dataclass
from typing import ClassVar, Final

from ...agents.agent import FRAME
from ...robots.nao.facts import HAND_OFFSET_X, HAND_OFFSET_Z, JOINTS
from ...robots.nao.kinematics import ARM_JOINTS, GRIP_X, GRIP_Y, REST_Z, arm_path
from ...robots.nao.urdf import arms_only_urdf
from .bullet import pybullet
from .engine import Vector, load_urdf_text
from .physics import Physics
from .servo import SERVO, Servo
from .table import PITCH, WEIGHT_SHARE

_HAND: Final = (HAND_OFFSET_X, 0.0, -HAND_OFFSET_Z)
"""The hand point in the frame of the last arm joint [m]; none of it is sideways."""

_ZEROS: Final = [0.0] * len(ARM_JOINTS)
_ONES: Final = [1.0] * len(ARM_JOINTS)


class NaoArms:
    """Both arms of the NAO, their servos, and the hands' hold of the table.

    The engine's joint motors are rigid up to the motors' torque limits. What a proportional
    servo of stiffness k adds is sag: a torque t displaces its joint by t / k. It enters through
    the set-point: with J = dz/dq of the hands, an arm whose weight turns its joints with the
    torques g(h), and which carries half of the load F that the hands bear, gives way by

        sag(h, F) = sum_i J_i (J_i F / 2 - g_i(h)) / k.

    A constant offset makes up for the sag at rest under the table's weight (see :class:`.Servo`);
    elsewhere along the stroke a little of it remains.
    """

    REST_GRIP: ClassVar[Vector] = (GRIP_X, 0.0, REST_Z)
    """Middle between the hands at rest, in the torso frame [m]."""

    def __init__(self, client: int, tree: int, physics: Physics, servo: Servo) -> None:
        self._client = client
        self._path = path = arm_path()
        self._angles = path.joints
        weight_sag = -path.levers * path.gravity_torques / servo.stiffness
        compliance = path.levers**2 / 2 / servo.stiffness
        self._weight_sag: list[float] = weight_sag.sum(axis=1).tolist()
        self._compliance: list[float] = compliance.sum(axis=1).tolist()
        self._body = load_urdf_text(client, arms_only_urdf(shapes=False), (0, 0, 0))
        self._joints = self._joint_indices()
        self._wrists = (self._joints[4], self._joints[9])
        self._efforts = [JOINTS[name].effort for name in ARM_JOINTS]
        self._gains = [-math.expm1(-physics.step / servo.time)] * len(ARM_JOINTS)
        # A set-point that ramps is followed with the servo's time constant at any step size.
        gain = self._gains[0]
        self._ahead = (physics.step / gain - servo.time) / FRAME
        self._yielding = -math.expm1(-FRAME / servo.load_time)
        for joint, angle in zip(self._joints, self._path.joint_angles(0.0), strict=True):
            pybullet.resetJointState(self._body, joint, angle, physicsClientId=client)
        for wrist, side in zip(self._wrists, (1, -1), strict=True):
            self._grip(wrist, (GRIP_X, side * GRIP_Y, REST_Z), tree)
        rest = path.row(0.0)
        sag = self._weight_sag[rest] + self._compliance[rest] * WEIGHT_SHARE
        self._offset = sag if servo.weight_offset else 0.0
        self.reset()

    def _joint_indices(self) -> list[int]:
        """Return the engine's indices of the arm joints, in the order of ``ARM_JOINTS``."""
        count = pybullet.getNumJoints(self._body, physicsClientId=self._client)
        names = [
            pybullet.getJointInfo(self._body, i, physicsClientId=self._client)[1].decode()
            for i in range(count)
        ]
        return [names.index(name) for name in ARM_JOINTS]

    def _grip(self, wrist: int, point: Vector, tree: int) -> None:
        """Pin a hand to the table at ``point`` (world frame)."""
        anchors = []
        for body, link in ((self._body, wrist), (tree, PITCH)):
            state = pybullet.getLinkState(
                body, link, computeForwardKinematics=1, physicsClientId=self._client
            )
            inverse = pybullet.invertTransform(state[0], state[1])
            anchors.append(pybullet.multiplyTransforms(*inverse, point, (0, 0, 0, 1))[0])
        pybullet.createConstraint(
            self._body,
            wrist,
            tree,
            PITCH,
            pybullet.JOINT_POINT2POINT,
            (0, 0, 0),
            *anchors,
            physicsClientId=self._client,
        )

    def reset(self) -> None:
        """Hold rest height; the engine's state itself is restored by the world."""
        self._load = WEIGHT_SHARE
        self._previous = self._target = self._row(0.0)

    def prepare(
        self, command: float, own: list[float], other: list[float], force: list[float]
    ) -> None:
        """Take the commanded height for the end of the next frame [m].

        ``force`` is the history of the hands' force on the table, newest last [N].
        """
        self._load += self._yielding * (force[-1] - self._load)
        self._previous = self._target
        self._target = self._row(command)

    def _row(self, command: float) -> int:
        """Return the row of the arms' path that is the set-point for a commanded height [m]."""
        row = self._path.row
        i = row(command)
        return row(command + self._offset - self._weight_sag[i] - self._compliance[i] * self._load)

    def drive(self, begin: float, height: float, velocity: float) -> float:
        """Set the motors for the physics step that begins at ``begin`` of the frame.

        Returns
        -------
        float
            No force: the motors' is the engine's to find.
        """
        previous = self._previous
        row = int(previous + (self._target - previous) * (begin + self._ahead) + 0.5)
        pybullet.setJointMotorControlArray(
            self._body,
            self._joints,
            pybullet.POSITION_CONTROL,
            self._angles[row],
            _ZEROS,
            self._efforts,
            self._gains,
            _ONES,
            self._client,
        )
        return 0.0

    def hand_height(self, end: float) -> float:
        """Return the mean height of the two hands [m] by forward kinematics of the joints.

        It differs from the table's ``end`` when the hands slip.
        """
        height = 0.0
        for state in pybullet.getLinkStates(
            self._body, self._wrists, computeForwardKinematics=1, physicsClientId=self._client
        ):
            x, y, z, w = state[5]
            height += state[4][2] + 2 * (x * z - y * w) * _HAND[0]
            height += (1 - 2 * (x * x + y * y)) * _HAND[2]
        return height / 2 - REST_Z


@dataclass(frozen=True)
class NaoFarEnd:
    """A NAO as the holder of the far end."""

    servo: Servo = SERVO
    """The position servo of its joints."""

    mass: ClassVar[float] = 0.0
    """No mass beside that of the robot's own bodies [kg]."""

    def hold(self, client: int, table: int, physics: Physics) -> NaoArms:
        """Grip the table with both hands; see :meth:`.FarEnd.hold`."""
        return NaoArms(client, table, physics, self.servo)
