"""The scene: NAO on its pedestal (or a second person), table, person; posed from two heights."""

import math
import os
from typing import Final

import numpy as np
import pybullet
from numpy.typing import NDArray

from ...agents.errors import InputError
from ...robots.arm_kinematics import ARM_JOINTS, GRIP_X, REST_Z, STROKE, arm_path
from ...robots.nao_facts import TORSO_HEIGHT
from ...robots.urdf import nao_urdf_path
from ..world import Partner
from ..world.table import TABLE_LENGTH
from .mannequin import Mannequin

Picture = NDArray[np.uint8]

PEDESTAL: Final = 0.50
"""Height of what the NAO stands on [m], so that its table is at a person's hands."""

FLOOR: Final = -TORSO_HEIGHT - PEDESTAL
RENDER_MODES: Final = (None, "human", "rgb_array")


def check_render_mode(mode: str | None) -> None:
    """Refuse a render mode that cannot be had.

    Raises
    ------
    InputError
        If the mode is unknown, or a window is wanted where there is no display.
    """
    if mode not in RENDER_MODES:
        raise InputError(f"render_mode must be None, 'human' or 'rgb_array', got {mode!r}")
    if mode == "human" and not os.environ.get("DISPLAY"):
        raise InputError("render_mode='human' needs a display (DISPLAY is not set)")


class Scene:
    """A picture or a window of one lift. Its engine is never stepped.

    Parameters
    ----------
    partner
        Who holds the robot's end.
    window
        Whether to open a window; otherwise everything is drawn headless.
    """

    def __init__(self, partner: Partner, *, window: bool = False) -> None:
        self._client: int = pybullet.connect(pybullet.GUI if window else pybullet.DIRECT)
        self._window = window
        far_hands = np.array([GRIP_X, 0.0, REST_Z])
        hands = far_hands + [TABLE_LENGTH, 0.0, 0.0]
        self._hands = hands
        self._box((0.4, 0.0, FLOOR - 0.01), (1.6, 1.1, 0.01), (0.86, 0.87, 0.88, 1.0))
        self._table = self._box(
            (0.0, 0.0, 0.0), (TABLE_LENGTH / 2 + 0.03, 0.2, 0.009), (0.72, 0.51, 0.30, 1.0)
        )
        self._person = Mannequin(self._client, hands, -1, FLOOR)
        self._second: Mannequin | None = None
        if partner == "human":
            self._second = Mannequin(self._client, far_hands, 1, FLOOR)
        else:
            self._box(
                (-0.02, 0.0, FLOOR + PEDESTAL / 2),
                (0.16, 0.18, PEDESTAL / 2),
                (0.55, 0.58, 0.62, 1.0),
            )
            self._load_nao()
        self.pose(0.0, 0.0)
        if window:
            pybullet.configureDebugVisualizer(
                pybullet.COV_ENABLE_GUI, 0, physicsClientId=self._client
            )
            pybullet.resetDebugVisualizerCamera(
                1.9, 20, -12, (0.55, 0.0, -0.1), physicsClientId=self._client
            )

    def _load_nao(self) -> None:
        self._nao: int = pybullet.loadURDF(
            str(nao_urdf_path()), useFixedBase=True, physicsClientId=self._client
        )
        count = pybullet.getNumJoints(self._nao, physicsClientId=self._client)
        names = [
            pybullet.getJointInfo(self._nao, i, physicsClientId=self._client)[1].decode()
            for i in range(count)
        ]
        self._arm_joints = [names.index(name) for name in ARM_JOINTS]

    def _box(
        self,
        position: tuple[float, float, float],
        half: tuple[float, float, float],
        colour: tuple[float, float, float, float],
    ) -> int:
        shape = pybullet.createVisualShape(
            pybullet.GEOM_BOX, halfExtents=half, rgbaColor=colour, physicsClientId=self._client
        )
        body: int = pybullet.createMultiBody(
            baseVisualShapeIndex=shape, basePosition=position, physicsClientId=self._client
        )
        return body

    def pose(self, human_end: float, robot_end: float) -> None:
        """Show the lift with the table's ends at these heights [m]."""
        self._person.pose(human_end)
        if self._second is not None:
            self._second.pose(robot_end)
        else:
            angles = arm_path().joint_angles(min(max(robot_end, STROKE[0]), STROKE[1]))
            for joint, angle in zip(self._arm_joints, angles, strict=True):
                pybullet.resetJointState(self._nao, joint, angle, physicsClientId=self._client)
        tilt = math.asin(min(max((robot_end - human_end) / TABLE_LENGTH, -1.0), 1.0))
        half = TABLE_LENGTH / 2
        centre = self._hands + [
            -half * math.cos(tilt),
            0.0,
            human_end + half * math.sin(tilt),
        ]
        pybullet.resetBasePositionAndOrientation(
            self._table,
            centre.tolist(),
            pybullet.getQuaternionFromEuler((0.0, tilt, 0.0)),
            physicsClientId=self._client,
        )

    def picture(self, width: int = 640, height: int = 400) -> Picture:
        """Return what is seen from the side, shape ``(height, width, 3)``."""
        view = pybullet.computeViewMatrix((0.75, -2.05, 0.22), (0.53, 0.0, -0.10), (0, 0, 1))
        projection = pybullet.computeProjectionMatrixFOV(42, width / height, 0.1, 6.0)
        _, _, pixels, _, _ = pybullet.getCameraImage(
            width,
            height,
            view,
            projection,
            lightDirection=(0.6, -1.5, 2.2),
            shadow=1,
            renderer=pybullet.ER_TINY_RENDERER,
            physicsClientId=self._client,
        )
        rgba = np.asarray(pixels, dtype=np.uint8).reshape(height, width, 4)
        return np.ascontiguousarray(rgba[..., :3])

    def close(self) -> None:
        """Close the engine, and the window with it."""
        if pybullet.isConnected(physicsClientId=self._client):
            pybullet.disconnect(physicsClientId=self._client)
