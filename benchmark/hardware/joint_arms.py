"""The NAO's arms in the world, moved joint by joint as ALMotion moves them."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Final

import numpy as np
from colift.benchmark.world.bullet_world import BulletWorld
from colift.benchmark.world.engine import BulletEngine
from colift.benchmark.world.human_body import BodyParameters
from colift.benchmark.world.interface import Engine, Intended
from colift.benchmark.world.nao_arms import NaoArms
from colift.benchmark.world.nao_end import NaoFarEnd
from colift.benchmark.world.servo import Servo
from colift.benchmark.world.table import WEIGHT_SHARE
from colift.robots.nao.kinematics import (
    ARM_JOINTS,
    MIRROR,
    arm_path,
    gravity_torque,
    vertical_lever,
)
from numpy.typing import NDArray

_MIRROR: Final = np.array(MIRROR)

SAME_POSTURE: Final = 0.02
"""Change of a joint [rad] up to which levers and torques are reused: the error is a tenth of a
millimetre at the hand, and it saves half of a frame's computing time."""

_KEPT: Final = 1000
"""Frames of history that the world keeps."""


class JointArms(NaoArms):
    """Both arms by ten set-points and ten stiffnesses, instead of by the hands' height.

    A joint yields by its torque over the servo's stiffness, as in :class:`.NaoArms`: here joint by
    joint, at the commanded angles,

        q_i = c_i + (g_i - J_i F / 2) / k.

    No offset compensates for the weight: the sender of the commands has to do that.
    """

    def __init__(self, engine: BulletEngine, servo: Servo) -> None:
        self.commanded: NDArray[np.float64] = np.array(arm_path().joint_angles(0.0))
        """Set-points at the end of the next frame [rad], in the order of ``ARM_JOINTS``."""
        self.stiffness: NDArray[np.float64] = np.ones(len(ARM_JOINTS))
        """Share of its torque that each motor has, 0 to 1."""
        self._compliant = 1 / servo.stiffness
        self._posture = np.full((2, 5), np.inf)
        super().__init__(engine, servo, apart=True)

    def reset(self) -> None:
        """Hold the commanded posture."""
        self._load = WEIGHT_SHARE
        self._from = self._to = self._set_points()

    def _set_points(self) -> NDArray[np.float64]:
        """Return the commanded angles plus the deflections of the joints [rad]."""
        sides = np.stack([self.commanded[:5], self.commanded[5:] * _MIRROR])
        if np.abs(sides - self._posture).max() > SAME_POSTURE:
            self._posture = sides
            self._gravity, self._lever = gravity_torque(sides), vertical_lever(sides)
        sag = self._gravity - self._lever * self._load / 2
        left, right = sides + sag * self._compliant
        return np.concatenate([left, right * _MIRROR])

    def prepare(
        self, command: float, own: list[float], other: list[float], force: list[float]
    ) -> None:
        """Take the commanded angles for the end of the next frame; ``command`` is ignored."""
        self._load += self._yielding * (force[-1] - self._load)
        self._from, self._to = self._to, self._set_points()

    def drive(self, begin: float, height: float, velocity: float) -> float:
        """Set the motors for the physics step that begins at ``begin`` of the frame."""
        angles = self._from + (self._to - self._from) * (begin + self._ahead)
        for arm, joints in self._arms:
            efforts = self.stiffness[joints] * arm.efforts
            arm.drive(angles[joints].tolist(), self._gains, efforts.tolist())
        return 0.0

    def angles(self) -> list[float]:
        """Return the joints' angles by the encoders [rad]."""
        return [angle for arm, _ in self._arms for angle in arm.angles()]


@dataclass(frozen=True)
class JointFarEnd(NaoFarEnd):
    """A NAO whose arms are moved joint by joint."""

    def hold(self, engine: Engine) -> JointArms:
        """Grip the table with both hands."""
        assert isinstance(engine, BulletEngine)
        return JointArms(engine, self.servo)


class JointWorld(BulletWorld):
    """A world that is never restored between two lifts."""

    def __init__(self, human: BodyParameters, servo: Servo) -> None:
        self._started = False
        super().__init__(human, JointFarEnd(servo))
        self._started = True

    def reset(self) -> None:
        """Put everything to rest, only once: real objects stay where they are."""
        if not self._started:
            super().reset()

    def advance(
        self,
        human_reference: Sequence[float],
        robot_reference: Sequence[float],
        intended: Intended | None = None,
    ) -> None:
        """Advance, and drop the oldest frames: a laboratory may run for days."""
        super().advance(human_reference, robot_reference, intended)
        if len(self.human_end) > 2 * _KEPT:
            for history in (
                self.human_end, self.human_velocity, self.human_force,
                self.robot_end, self.robot_velocity, self.robot_force,
            ):  # fmt: skip
                del history[:-_KEPT]

    @property
    def joint_arms(self) -> JointArms:
        """The NAO's arms."""
        assert isinstance(self.hands, JointArms)
        return self.hands
