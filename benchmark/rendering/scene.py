"""The scene: a robot on its pedestal or a second person, table, person; posed from two heights."""

import logging
import math
import os
from collections.abc import Sequence
from typing import Final

import numpy as np
from colift.benchmark.rendering.bodies import PERSON, no_picture, shown_body
from colift.benchmark.rendering.caption import letters
from colift.benchmark.rendering.mannequin import Mannequin
from colift.benchmark.rendering.solids import box, disc, limb
from colift.benchmark.rendering.style import AIM, HUMAN, INK, ROBOT, SKY, rgba
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

WOOD: Final = (0.80, 0.62, 0.42, 1.0)
MEANT: Final = (0.25, 0.55, 0.30, 1.0)
STAGE: Final = (0.90, 0.91, 0.93, 1.0)
SHADE: Final = (0.80, 0.82, 0.85, 1.0)
STONE: Final = (0.66, 0.70, 0.75, 1.0)

BALL: Final = 0.03
"""Radius of a ball in pictures [m]."""

BALL_COLOUR: Final = (0.20, 0.22, 0.26, 1.0)

EDGE: Final = 0.04
"""Half length of the coloured piece at each end of the table [m]."""

EYE: Final = (0.18, -2.55, 0.42)
"""Place of the camera [m]: to the right of the middle of the picture, before it, above it."""

HALF_HEIGHT: Final = 0.93
"""Half of the height that the camera has to show [m]: the person from head to foot."""

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
    intended
        Whether :meth:`intend` will show an intended pose of the table.
    ball
        Whether :meth:`roll` will show a ball on the table.
    window
        Whether to open a window, if there is a display; otherwise all is drawn headless.
    """

    def __init__(
        self, partner: str, *, intended: bool = False, ball: bool = False, window: bool = False
    ) -> None:
        window = window and _display_there()
        self._client: int = pybullet.connect(pybullet.GUI if window else pybullet.DIRECT)
        far_hands = np.array(FAR_GRIP)
        hands = far_hands + [TABLE_LENGTH, 0.0, 0.0]
        self._hands = hands
        client = self._client
        middle = float(far_hands[0]) + TABLE_LENGTH / 2
        disc(client, np.array([middle, 0.0, FLOOR]), 1.0, STAGE)
        edge = TABLE_LENGTH / 2 - 0.01
        self._table = [
            (offset, box(client, hands, (half, 0.2, 0.010), colour))
            for offset, half, colour in (
                (0.0, edge - EDGE, WOOD),
                (edge, EDGE, rgba(HUMAN)),
                (-edge, EDGE, rgba(ROBOT)),
            )
        ]
        self._intended = (
            [(0.0, box(client, hands, (edge + EDGE, 0.03, 0.003), MEANT))] if intended else []
        )
        self._ball = (
            (
                limb(client, 0.0, (BALL, BALL), BALL_COLOUR),
                box(client, hands, (0.012, 0.21, 0.014), rgba(AIM)),
            )
            if ball
            else None
        )
        self._ends = 0.0, 0.0
        stands = [hands[0] + 0.37]
        # The middle of the picture [m], and the width to be shown on each side of it.
        body = shown_body(partner)
        self._middle, self._half_width = (middle, 1.08) if body == PERSON else (0.65, 0.92)
        self._person = Mannequin(client, hands, -1, FLOOR, rgba(HUMAN))
        self._second: Mannequin | None = None
        self._robot: Robot | None = None
        self._words = no_picture(partner) if body is None else ""
        if body == PERSON:
            self._second = Mannequin(client, far_hands, 1, FLOOR, rgba(ROBOT))
            stands.append(far_hands[0] - 0.37)
        elif body is not None:
            x, _, z = body.place
            half = (z + body.foot - FLOOR) / 2
            box(client, np.array([x - 0.01, 0.0, FLOOR + half]), (0.14, 0.15, half), STONE)
            self._load(body)
            stands.append(x - 0.01)
        for x in stands:
            disc(client, np.array([x, 0.0, FLOOR + 0.004]), 0.30, SHADE)
        self.pose(0.0, 0.0)
        if window:
            pybullet.configureDebugVisualizer(
                pybullet.COV_ENABLE_GUI, 0, physicsClientId=self._client
            )
            pybullet.resetDebugVisualizerCamera(
                1.9, 20, -12, (0.55, 0.0, -0.1), physicsClientId=self._client
            )

    def _load(self, robot: Robot) -> None:
        self._robot = robot
        self._body, self._joints = load_model(self._client, robot)

    def pose(self, human_end: float, robot_end: float) -> None:
        """Show the lift with the table's ends at these heights [m]."""
        tilt = math.asin(min(max((robot_end - human_end) / TABLE_LENGTH, -1.0), 1.0))
        self._person.pose(human_end, tilt)
        if self._second is not None:
            self._second.pose(robot_end, tilt)
        elif self._robot is not None:
            for name, angle in self._robot.posture(robot_end).items():
                joint = self._joints[name]
                pybullet.resetJointState(self._body, joint, angle, physicsClientId=self._client)
        self._place(self._table, human_end, tilt)
        self._ends = human_end, tilt

    def roll(self, ball: float, target: float) -> None:
        """Show a ball, and where it should be [m] from the table's middle towards the robot.

        It lies on the table as :meth:`pose` has placed it.
        """
        assert self._ball is not None
        body, mark = self._ball
        human_end, tilt = self._ends
        self._place([(-ball, body)], human_end, tilt, above=BALL + 0.01)
        self._place([(-target, mark)], human_end, tilt)

    def intend(self, human_end: float, robot_end: float) -> None:
        """Show the pose with the table's ends at these heights [m] as intended."""
        tilt = math.asin(min(max((robot_end - human_end) / TABLE_LENGTH, -1.0), 1.0))
        self._place(self._intended, human_end, tilt)

    def _place(
        self,
        parts: Sequence[tuple[float, int]],
        human_end: float,
        tilt: float,
        above: float = 0.0,
    ) -> None:
        """Place parts of a table, by their distances from its middle towards the human [m]."""
        along = np.array([math.cos(tilt), 0.0, -math.sin(tilt)])
        grip = self._hands + [0.0, 0.0, human_end]
        grip = grip + above * np.array([math.sin(tilt), 0.0, math.cos(tilt)])
        for offset, part in parts:
            centre = grip + (offset - TABLE_LENGTH / 2) * along
            pybullet.resetBasePositionAndOrientation(
                part,
                centre.tolist(),
                pybullet.getQuaternionFromEuler((0.0, tilt, 0.0)),
                physicsClientId=self._client,
            )

    def picture(self, width: int = 640, height: int = 400) -> Picture:
        """Return the view from the side, shape ``(height, width, 3)``.

        Everybody is shown from head to foot, whatever the shape of the picture.
        """
        wide, high = SMOOTHING * width, SMOOTHING * height
        eye = (self._middle + EYE[0], EYE[1], EYE[2])
        view = pybullet.computeViewMatrix(eye, (self._middle, 0.0, 0.0), (0, 0, 1))
        half = max(HALF_HEIGHT, self._half_width * height / width) / math.hypot(*EYE)
        projection = pybullet.computeProjectionMatrixFOV(
            2 * math.degrees(math.atan(half)), width / height, 0.1, 6.0
        )
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
            physicsClientId=self._client,
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
        if pybullet.isConnected(physicsClientId=self._client):
            pybullet.disconnect(physicsClientId=self._client)
