"""The NAO's arms at the far end of the table."""

import math
from typing import Final

from colift.agents.agent import FRAME
from colift.benchmark.world.engine import BulletEngine
from colift.benchmark.world.nao_arm import NaoArm
from colift.benchmark.world.servo import Servo
from colift.benchmark.world.table import PITCH
from colift.robots.nao.facts import ARM
from colift.robots.nao.kinematics import GRIP_X, GRIP_Y, REST_Z, arm_path

_HALF: Final = len(ARM)
"""Number of joints of one arm; in lists of both arms, the left arm's angles come first."""

_SIDES: Final = (("L", slice(0, _HALF), GRIP_Y), ("R", slice(_HALF, None), -GRIP_Y))
"""The arms: their joints in a list of both, and the distance of the hand from the middle [m]."""


class NaoArms:
    """The arms of the NAO, their servos, and the hands' hold of the table.

    The arms are mirror images, and so are their set-points: the right does what the left does.
    Therefore the engine has the left arm alone, with twice its mass, inertia and torque, in less
    than two thirds of the time. With ``apart`` it has both.

    The engine's joint motors are rigid up to the motors' torque limits. A proportional servo of
    stiffness k adds sag: a torque t displaces its joint by t / k. It enters through the set-point:
    with J = dz/dq of the hands, an arm whose weight turns its joints with the torques g(h), and
    which carries half of the load F on the hands, yields by

        sag(h, F) = sum_i J_i (J_i F / 2 - g_i(h)) / k.

    A constant offset compensates for the sag at rest under the table's weight (see
    :class:`.Servo`); elsewhere along the stroke a little of it remains.
    """

    def __init__(self, engine: BulletEngine, servo: Servo, *, apart: bool = False) -> None:
        physics = engine.physics
        self._path = path = arm_path()
        self._angles = path.joints
        weight_sag = -path.levers * path.gravity_torques / servo.stiffness
        compliance = path.levers**2 / 2 / servo.stiffness
        self._weight_sag: list[float] = weight_sag.sum(axis=1).tolist()
        self._compliance: list[float] = compliance.sum(axis=1).tolist()
        gain = -math.expm1(-physics.step / servo.time)
        self._gains = [gain] * _HALF
        # A ramping set-point is followed with the servo's time constant at any step size.
        self._ahead = (physics.step / gain - servo.time) / FRAME
        self._yielding = -math.expm1(-FRAME / servo.load_time)
        angles = path.joint_angles(0.0)
        sides, each = (_SIDES, 1) if apart else (_SIDES[:1], len(_SIDES))
        self._arms = [
            (NaoArm(engine.client, side, angles[joints], each), joints) for side, joints, _ in sides
        ]
        for (arm, _), (_, _, aside) in zip(self._arms, sides, strict=True):
            arm.grip(engine.table, PITCH, (GRIP_X, aside, REST_Z))
        rest = path.row(0.0)
        sag = self._weight_sag[rest] + self._compliance[rest] * engine.weight_share
        self._offset = sag if servo.weight_offset else 0.0
        self._share = engine.weight_share
        self.reset()

    def reset(self) -> None:
        """Hold rest height; the engine's state itself is restored by the world."""
        self._load = self._share
        self._previous = self._target = self._row(0.0)
        self._driven = -1

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
            0: the engine itself computes the force of the motors.
        """
        previous = self._previous
        row = int(previous + (self._target - previous) * (begin + self._ahead) + 0.5)
        if row != self._driven:
            self._driven = row
            angles = self._angles[row]
            for arm, joints in self._arms:
                arm.drive(angles[joints], self._gains, arm.efforts)
        return 0.0

    def hand_height(self, end: float) -> float:
        """Return the mean height of the hands [m] by forward kinematics of the joints.

        It differs from the table's ``end`` when the hands slip.
        """
        heights = [arm.hand_height() for arm, _ in self._arms]
        return sum(heights) / len(heights) - REST_Z
