"""The scene: a robot on its pedestal or a second person, table, person; posed from two heights."""

import logging
import os
from collections.abc import Sequence
from typing import Final

import numpy as np
from colift.benchmark.episode.drawn import DrawnHurdle
from colift.benchmark.rendering.bodies import PERSON, no_picture, shown_body
from colift.benchmark.rendering.cameras import CAMERAS, SIDE
from colift.benchmark.rendering.caption import letters
from colift.benchmark.rendering.mannequin import Mannequin
from colift.benchmark.rendering.solids import Solids, box, disc
from colift.benchmark.rendering.style import HUMAN, INK, ROBOT, SKY, rgba
from colift.benchmark.rendering.tabletop import Tabletop, tilt_of
from colift.benchmark.robots.model import load_model
from colift.benchmark.robots.robot import Robot
from colift.benchmark.world.bullet import pybullet
from colift.benchmark.world.table import FAR_GRIP, TABLE_LENGTH
from colift.robots.nao.facts import TORSO_HEIGHT
from numpy.typing import NDArray
from PIL import Image, ImageColor, ImageDraw

Picture = NDArray[np.uint8]

PEDESTAL: Final = 0.50
"""Height of the NAO's pedestal [m], such that its table is at a person's hands."""

FLOOR: Final = -TORSO_HEIGHT - PEDESTAL

STAGE: Final = (0.90, 0.91, 0.93, 1.0)
SHADE: Final = (0.80, 0.82, 0.85, 1.0)
STONE: Final = (0.66, 0.70, 0.75, 1.0)

SMOOTHING: Final = 2
"""Pixels drawn for one pixel seen, in each direction: the renderer leaves edges jagged."""


def _display_there() -> bool:
    """Return whether a window can be opened; if not, log a warning."""
    if os.environ.get("DISPLAY"):
        return True
    logging.getLogger("colift").warning("no display (DISPLAY is not set): no window is shown")
    return False


class Scene:
    """A picture or a window of one lift. Its engine is never stepped.

    Parameters
    ----------
    partner
        Holder of the robot's end. A robot of which there is no picture is replaced by words.
    intended, ball, hurdles
        What the task shows at the :attr:`table`; see :class:`.Tabletop`.
    camera
        Name of the camera; see :data:`.CAMERAS`.
    window
        Whether to open a window, if there is a display; otherwise all is drawn headless.
    """

    def __init__(
        self,
        partner: str,
        *,
        intended: bool = False,
        ball: bool = False,
        hurdles: Sequence[DrawnHurdle] = (),
        camera: str = SIDE,
        window: bool = False,
    ) -> None:
        window = window and _display_there()
        self.client: int = pybullet.connect(pybullet.GUI if window else pybullet.DIRECT)
        """The engine."""
        self.solids = Solids(self.client)
        """All that is seen but the robot."""
        self._camera = CAMERAS[camera]
        far_hands = np.array(FAR_GRIP)
        hands = far_hands + [TABLE_LENGTH, 0.0, 0.0]
        middle = float(far_hands[0]) + TABLE_LENGTH / 2
        self.solids.add("stage", disc(1.0), STAGE, np.array([middle, 0.0, FLOOR]))
        self.table = Tabletop(self.solids, hands, intended=intended, ball=ball, hurdles=hurdles)
        """The table."""
        stands = [hands[0] + 0.37]
        # The middle of the picture [m], and the width to be shown on each side of it.
        body = shown_body(partner)
        self._middle, self._half_width = (middle, 1.08) if body == PERSON else (0.65, 0.92)
        self._person = Mannequin(self.solids, "human", hands, -1, FLOOR, rgba(HUMAN))
        self._second: Mannequin | None = None
        self.robot: int | None = None
        """The robot's body in the engine; None if there is none."""
        self._robot: Robot | None = None
        self._words = no_picture(partner) if body is None else ""
        if body == PERSON:
            self._second = Mannequin(self.solids, "partner", far_hands, 1, FLOOR, rgba(ROBOT))
            stands.append(far_hands[0] - 0.37)
        elif body is not None:
            x, _, z = body.place
            half = (z + body.foot - FLOOR) / 2
            place = np.array([x - 0.01, 0.0, FLOOR + half])
            self.solids.add("pedestal", box((0.14, 0.15, half)), STONE, place)
            self._robot = body
            self.robot, self._joints = load_model(self.client, body)
            stands.append(x - 0.01)
        for x in stands:
            self.solids.add("shade", disc(0.30), SHADE, np.array([x, 0.0, FLOOR + 0.004]))
        self.pose(0.0, 0.0)
        if window:
            pybullet.configureDebugVisualizer(
                pybullet.COV_ENABLE_GUI, 0, physicsClientId=self.client
            )
            pybullet.resetDebugVisualizerCamera(
                1.9, 20, -12, (0.55, 0.0, -0.1), physicsClientId=self.client
            )

    def pose(self, human_end: float, robot_end: float) -> None:
        """Show the lift with the table's ends at these heights [m]."""
        tilt = tilt_of(human_end, robot_end)
        self._person.pose(human_end, tilt)
        if self._second is not None:
            self._second.pose(robot_end, tilt)
        elif self._robot is not None:
            for name, angle in self._robot.posture(robot_end).items():
                joint = self._joints[name]
                pybullet.resetJointState(self.robot, joint, angle, physicsClientId=self.client)
        self.table.pose(human_end, robot_end)

    def picture(self, width: int = 640, height: int = 400) -> Picture:
        """Return the camera's view, shape ``(height, width, 3)``.

        Everybody is shown from head to foot, whatever the shape of the picture.
        """
        wide, high = SMOOTHING * width, SMOOTHING * height
        view, projection = self._camera.matrices(self._middle, self._half_width, (width, height))
        _, _, pixels, _, bodies = pybullet.getCameraImage(
            wide,
            high,
            view,
            projection,
            lightDirection=(0.5, -1.6, 2.4),
            lightAmbientCoeff=0.62,
            lightDiffuseCoeff=0.42,
            lightSpecularCoeff=0.05,
            shadow=0,
            renderer=pybullet.ER_TINY_RENDERER,
            physicsClientId=self.client,
        )
        seen = np.asarray(pixels, dtype=np.uint8).reshape(high, wide, 4)[..., :3].copy()
        seen[np.asarray(bodies).reshape(high, wide) < 0] = ImageColor.getrgb(SKY)
        picture = Image.fromarray(seen).reduce(SMOOTHING)
        if self._words:
            size = max(8, height // 24)
            ImageDraw.Draw(picture).text(
                (size, height // 2), self._words, fill=INK, font=letters(size)
            )
        return np.array(picture)

    def close(self) -> None:
        """Close the engine, and the window with it."""
        if pybullet.isConnected(physicsClientId=self.client):
            pybullet.disconnect(physicsClientId=self.client)
