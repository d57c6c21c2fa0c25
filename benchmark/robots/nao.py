"""The NAO of the paper: two arms moved by position servos."""

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import ClassVar

from colift.agents.actions import HAND_SPEED
from colift.benchmark.world.nao_end import NaoFarEnd
from colift.robots.nao import kinematics
from colift.robots.nao.facts import TORSO_HEIGHT
from colift.robots.nao.urdf import nao_urdf_path


@dataclass(frozen=True)
class Nao(NaoFarEnd):
    """A NAO, with both hands at the table."""

    label: ClassVar[str] = "robot"
    control: ClassVar[str] = "position servos"
    stroke: ClassVar[tuple[float, float]] = kinematics.STROKE
    hand_speed: ClassVar[float] = HAND_SPEED
    place: ClassVar[tuple[float, float, float]] = (0.0, 0.0, 0.0)
    foot: ClassVar[float] = -TORSO_HEIGHT

    def model(self) -> Path:
        """Return the whole robot's URDF file."""
        return nao_urdf_path()

    def posture(self, height: float) -> Mapping[str, float]:
        """Return the angles of both arms [rad] for hands at a displacement [m]."""
        low, high = self.stroke
        angles = kinematics.arm_path().joint_angles(min(max(height, low), high))
        return dict(zip(kinematics.ARM_JOINTS, angles, strict=True))
