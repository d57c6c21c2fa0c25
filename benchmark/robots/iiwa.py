"""A KUKA LBR iiwa at the far end: seven torque-controlled joints, the model that PyBullet ships.

The paper speculates that "sophisticated velocity or torque controlled robots would yield smoother
motions and offer better improvements in performance" than the NAO (section V.A).
"""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cache
from importlib.resources import files
from pathlib import Path
from typing import ClassVar, Final

from colift.agents.actions import HAND_SPEED
from colift.agents.agent import FRAME
from colift.benchmark.world.bullet import pybullet
from colift.benchmark.world.engine import BulletEngine, Vector, load_urdf, pin
from colift.benchmark.world.interface import Engine
from colift.benchmark.world.table import FAR_GRIP, PITCH

JOINTS: Final = 7
"""Number of joints."""

HAND: Final = JOINTS - 1
"""The link that holds the table."""

BELOW: Final = 0.42
"""Height of the hand above the base at rest [m]: the middle of the stroke is at half reach."""

AHEAD: Final = 0.55
"""Distance of the hand in front of the base [m]."""

BASE: Final = (FAR_GRIP[0] - AHEAD, 0.0, FAR_GRIP[2] - BELOW)
"""Place of the base in the world [m]."""

STROKE: Final = (-0.10, 0.40)
"""Lowest and highest displacement of the hand [m]."""

ROW: Final = 1e-3
"""Height between two rows of the table of postures [m]; between them, postures are interpolated."""

READY: Final = (0.0, 0.5, 0.0, -1.4, 0.0, 1.2, 0.0)
"""A posture with the elbow up and the hand horizontal [rad], from which postures are sought."""

STIFFNESS: Final = 35.0
"""omega, natural frequency of the joint impedance [1/s]: 4 to 6 kN/m at the hand, the stiffest
that the maker states for Cartesian impedance (5 kN/m)."""

DAMPING: Final = 0.9
"""zeta, damping ratio of the joint impedance."""

EFFORT: Final = (320.0, 320.0, 176.0, 176.0, 110.0, 40.0, 40.0)
"""Largest torques of an LBR iiwa 14 R820 [Nm], from its data sheet."""

ITERATIONS: Final = 200
"""Steps of the search for a posture."""


def urdf_path() -> Path:
    """Return the model that comes with PyBullet."""
    return Path(str(files("pybullet_data"))) / "kuka_iiwa" / "model.urdf"


@cache
def postures() -> tuple[tuple[float, ...], ...]:
    """Return the joint angles [rad] for hands at heights from the bottom of the stroke, row by row.

    The hand keeps its direction, straight down, and moves on a vertical line.
    """
    client: int = pybullet.connect(pybullet.DIRECT)
    try:
        body = load_urdf(client, urdf_path(), (0.0, 0.0, 0.0))
        down = pybullet.getQuaternionFromEuler((0.0, math.pi, 0.0))
        rows = []
        angles: Sequence[float] = READY
        for row in range(round((STROKE[1] - STROKE[0]) / ROW) + 1):
            place = (AHEAD, 0.0, BELOW + STROKE[0] + row * ROW)
            for _ in range(ITERATIONS if row == 0 else 20):
                for joint, angle in enumerate(angles):
                    pybullet.resetJointState(body, joint, angle, physicsClientId=client)
                angles = pybullet.calculateInverseKinematics(
                    body, HAND, place, down, maxNumIterations=20, residualThreshold=1e-9,
                    physicsClientId=client,
                )  # fmt: skip
            rows.append(tuple(angles))
        return tuple(rows)
    finally:
        pybullet.disconnect(client)


def posture(height: float) -> list[float]:
    """Return the joint angles [rad] for a hand at a displacement [m], within its stroke."""
    rows = postures()
    place = min(max((height - STROKE[0]) / ROW, 0.0), len(rows) - 1.0)
    index = min(int(place), len(rows) - 2)
    share = place - index
    return [a + share * (b - a) for a, b in zip(rows[index], rows[index + 1], strict=True)]


class IiwaArm:
    """The arm, its control, and its hold of the table.

    Computed torques make the joints an impedance about the commanded posture c,

        tau = M(q) (omega^2 (c - q) + 2 zeta omega (c' - q')) + g(q) + J^T W,

    with the mass matrix M, gravity g and the share W of the table's weight fed forward. The
    impedance is evaluated implicitly, so that it is stable at the engine's step.
    """

    def __init__(self, engine: BulletEngine) -> None:
        self._client, step = engine.client, engine.physics.step
        self._share = engine.weight_share
        self._body = load_urdf(self._client, urdf_path(), BASE)
        self._joints = list(range(JOINTS))
        self._rest = posture(0.0)
        for joint, angle in enumerate(self._rest):
            pybullet.resetJointState(self._body, joint, angle, physicsClientId=self._client)
        pybullet.setJointMotorControlArray(
            self._body, self._joints, pybullet.VELOCITY_CONTROL, forces=[0.0] * JOINTS,
            physicsClientId=self._client,
        )  # fmt: skip
        pin(self._client, (self._body, HAND), (engine.table, PITCH), FAR_GRIP)
        spring, damper = STIFFNESS**2, 2 * DAMPING * STIFFNESS
        implicit = 1 + step * damper / 2 + step * step * spring / 4
        self._spring, self._damper = spring / implicit, damper / implicit
        self._height = self._hand()
        self.reset()

    def reset(self) -> None:
        """Hold rest height; the engine's state itself is restored by the world."""
        self._from = self._to = self._rest

    def prepare(
        self, command: float, own: list[float], other: list[float], force: list[float]
    ) -> None:
        """Take the commanded height for the end of the next frame [m]."""
        self._from, self._to = self._to, posture(command)

    def drive(self, begin: float, height: float, velocity: float) -> float:
        """Set the torques for the physics step that begins at ``begin`` of the frame.

        Returns
        -------
        float
            0: the engine itself moves the arm.
        """
        client, body = self._client, self._body
        states = pybullet.getJointStates(body, self._joints, physicsClientId=client)
        angles, rates = [each[0] for each in states], [each[1] for each in states]
        wanted = [
            self._spring * (a + (b - a) * begin - q) + self._damper * ((b - a) / FRAME - rate)
            for a, b, q, rate in zip(self._from, self._to, angles, rates, strict=True)
        ]
        still = [0.0] * JOINTS
        torques = pybullet.calculateInverseDynamics(
            body, angles, still, wanted, physicsClientId=client
        )
        linear, _ = pybullet.calculateJacobian(
            body, HAND, (0.0, 0.0, 0.0), angles, still, still, physicsClientId=client
        )
        torques = [
            min(max(torque + lever * self._share, -most), most)
            for torque, lever, most in zip(torques, linear[2], EFFORT, strict=True)
        ]
        pybullet.setJointMotorControlArray(
            body, self._joints, pybullet.TORQUE_CONTROL, forces=torques, physicsClientId=client
        )
        return 0.0

    def hand_height(self, end: float) -> float:
        """Return the height of the hand [m] by forward kinematics of the joints."""
        return self._hand() - self._height

    def _hand(self) -> float:
        state = pybullet.getLinkState(self._body, HAND, 0, 1, self._client)
        return float(state[4][2])


@dataclass(frozen=True)
class Iiwa:
    """A KUKA LBR iiwa on a pedestal, with one hand at the table."""

    mass: ClassVar[float] = 0.0
    carries: ClassVar[bool] = False
    label: ClassVar[str] = "iiwa"
    control: ClassVar[str] = "joint torques"
    stroke: ClassVar[tuple[float, float]] = STROKE
    hand_speed: ClassVar[float] = HAND_SPEED
    place: ClassVar[Vector] = BASE
    foot: ClassVar[float] = 0.0

    def hold(self, engine: Engine) -> IiwaArm:
        """Hold the table with the hand; see :meth:`.FarEnd.hold`."""
        assert isinstance(engine, BulletEngine)
        return IiwaArm(engine)

    def model(self) -> Path:
        """Return the URDF file that comes with PyBullet."""
        return urdf_path()

    def posture(self, height: float) -> Mapping[str, float]:
        """Return the joint angles [rad] for a hand at a displacement [m]."""
        names = (f"lbr_iiwa_joint_{number}" for number in range(1, JOINTS + 1))
        return dict(zip(names, posture(height), strict=True))
