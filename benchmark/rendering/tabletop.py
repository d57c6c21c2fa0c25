"""The table of a scene, and what a task shows at it: a ball, an intended pose, hurdles."""

import math
from collections.abc import Sequence
from typing import Final

import numpy as np
from colift.benchmark.episode.drawn import DrawnHurdle
from colift.benchmark.rendering.solids import Colour, Point, Solids, box, limb
from colift.benchmark.rendering.style import AIM, COLOURS, HUMAN, PAPER, ROBOT, mixed, rgba
from colift.benchmark.world.table import TABLE_LENGTH

WOOD: Final = (0.80, 0.62, 0.42, 1.0)
MEANT: Final = (0.16, 0.70, 0.34, 1.0)

BALL: Final = 0.03
"""Radius of a ball in pictures [m]."""

BALL_COLOUR: Final = (0.20, 0.22, 0.26, 1.0)

HALF_WIDTH: Final = 0.2
HALF_HEIGHT: Final = 0.010
"""Half of the table's width and of its thickness [m]."""

EDGE: Final = 0.04
"""Half length of the coloured piece at each end of the table [m]."""

BEFORE: Final = HALF_WIDTH + 0.025
"""Distance before the table's middle at which bars are seen in front of it [m]."""

CLOSED: Final = 0.35
"""Share of its colour that a hurdle has while it is closed."""


def tilt_of(human_end: float, robot_end: float) -> float:
    """Return the pitch of a table whose ends are at these heights [rad]."""
    return math.asin(min(max((robot_end - human_end) / TABLE_LENGTH, -1.0), 1.0))


class Tabletop:
    """The table, and what lies on it or is marked beside it.

    Parameters
    ----------
    solids
        The solids of the scene.
    hands
        Middle between the human's hands at rest [m].
    intended
        Whether :meth:`intend` will show an intended pose.
    ball
        Whether :meth:`roll` will show a ball.
    hurdles
        The hurdles, which :meth:`open` shows: a thin bar beside the whole table, and a thick one
        while a hurdle is open.
    """

    def __init__(
        self,
        solids: Solids,
        hands: Point,
        *,
        intended: bool = False,
        ball: bool = False,
        hurdles: Sequence[DrawnHurdle] = (),
    ) -> None:
        self._solids = solids
        self._hands = hands
        edge = TABLE_LENGTH / 2 - 0.01
        self._pieces = [
            (offset, self._box(name, (half, HALF_WIDTH, HALF_HEIGHT), colour))
            for name, offset, half, colour in (
                ("table", 0.0, edge - EDGE, WOOD),
                ("human's end", edge, EDGE, rgba(HUMAN)),
                ("robot's end", -edge, EDGE, rgba(ROBOT)),
            )
        ]
        bar = TABLE_LENGTH / 2 - 2 * EDGE
        self._intended = (
            self._box("intended pose", (edge + EDGE, 0.006, 0.006), MEANT) if intended else None
        )
        self._ball = (
            (
                solids.add("ball", limb(0.0, (BALL, BALL)), BALL_COLOUR),
                self._box("target", (0.012, HALF_WIDTH + 0.01, HALF_HEIGHT + 0.004), rgba(AIM)),
            )
            if ball
            else None
        )
        self._hurdles = []
        for each in hurdles:
            colour = COLOURS[each.where]
            thin = self._box(
                f"{each.label}, closed", (bar, 0.003, 0.003), mixed(colour, PAPER, CLOSED)
            )
            thick = self._box(f"{each.label}, open", (bar, 0.007, 0.007), rgba(colour))
            self._hurdles.append((each.height, thin, thick))
        self.pose(0.0, 0.0)
        self.open([False] * len(hurdles))

    def _box(self, name: str, half: tuple[float, float, float], colour: Colour) -> int:
        return self._solids.add(name, box(half), colour, self._hands)

    def pose(self, human_end: float, robot_end: float) -> None:
        """Show the table with its ends at these heights [m]."""
        self._ends = human_end, robot_end
        for offset, part in self._pieces:
            self._place(part, self._ends, offset)

    def intend(self, human_end: float, robot_end: float) -> None:
        """Show the pose with the table's ends at these heights [m] as intended."""
        assert self._intended is not None
        self._place(self._intended, (human_end, robot_end), before=BEFORE)

    def roll(self, ball: float, target: float) -> None:
        """Show a ball, and where it should be [m] from the table's middle towards the robot.

        It lies on the table as :meth:`pose` has placed it.
        """
        assert self._ball is not None
        body, mark = self._ball
        self._place(body, self._ends, -ball, above=BALL + HALF_HEIGHT)
        self._place(mark, self._ends, -target)

    def open(self, states: Sequence[bool]) -> None:
        """Show which hurdles are open, for the table as :meth:`pose` has placed it.

        The thick bar of a closed one is inside the table.
        """
        for (height, thin, thick), opened in zip(self._hurdles, states, strict=True):
            there = height, height
            self._place(thin, there, before=BEFORE)
            if opened:
                self._place(thick, there, before=BEFORE)
            else:
                self._place(thick, self._ends)

    def _place(
        self,
        body: int,
        ends: tuple[float, float],
        offset: float = 0.0,
        *,
        above: float = 0.0,
        before: float = 0.0,
    ) -> None:
        """Place a part of a table with its ends at these heights.

        Its distances from the middle are towards the human, above, and towards the viewer [m].
        """
        tilt = tilt_of(*ends)
        along = np.array([math.cos(tilt), 0.0, -math.sin(tilt)])
        upwards = np.array([math.sin(tilt), 0.0, math.cos(tilt)])
        middle = self._hands + [0.0, -before, ends[0]] - TABLE_LENGTH / 2 * along
        turn = np.array([0.0, math.sin(tilt / 2), 0.0, math.cos(tilt / 2)])
        self._solids.place(body, middle + offset * along + above * upwards, turn)
