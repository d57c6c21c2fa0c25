"""The forces of a lift: hands on a spring and a damper, the table, and the robot's pinned hands."""

import math

import numpy as np
from colift.benchmark.rendering.style import FAINT, HUMAN, INK, LINE, ROBOT
from matplotlib.axes import Axes
from matplotlib.patches import Circle, Polygon
from sheet import Place, arrow, sheet, write

WOOD = "#CC9E6B"
REST = 9.0
NEAR, FAR = (74.0, 31.0), (27.0, 26.0)
"""The table's ends: the person's, and the robot's."""
MEANT = 45.0


def spring(axes: Axes, foot: Place, top: float) -> None:
    """Draw an upright spring."""
    x, y = foot
    turns = np.linspace(0, 1, 12)
    aside = np.where(np.arange(12) % 2, 1.6, -1.6)
    aside[[0, -1]] = 0
    axes.plot(x + aside, y + 1 + turns * (top - y - 2), color=INK, linewidth=1.2)
    axes.plot([x, x], [y, y + 1], color=INK, linewidth=1.2)
    axes.plot([x, x], [top - 1, top], color=INK, linewidth=1.2)


def damper(axes: Axes, foot: Place, top: float) -> None:
    """Draw an upright damper."""
    x, y = foot
    middle = (y + top) / 2
    axes.plot([x, x], [y, middle - 2], color=INK, linewidth=1.2)
    cup = [
        (x - 1.8, middle + 1.5),
        (x - 1.8, middle - 2),
        (x + 1.8, middle - 2),
        (x + 1.8, middle + 1.5),
    ]
    axes.plot(*zip(*cup, strict=True), color=INK, linewidth=1.2)
    axes.plot([x - 1.2, x + 1.2], [middle, middle], color=INK, linewidth=1.2)
    axes.plot([x, x], [middle, top], color=INK, linewidth=1.2)


def height(axes: Axes, x: float, top: float, name: str, colour: str) -> None:
    """Draw the height of an end above the rest height."""
    arrow(axes, (x, REST), (x, top), colour=colour, arrowstyle="<|-|>", linewidth=1.0)
    axes.text(x + 1.2, (REST + top) / 2, name, color=colour, va="center")


figure, axes = sheet(100, 62)
axes.plot([3, 97], [REST, REST], color=LINE, linewidth=1.2, linestyle=(0, (4, 3)))
axes.text(50, REST - 1.2, "rest height", color=FAINT, ha="center", va="top", size=8)

along = np.subtract(NEAR, FAR) / math.dist(NEAR, FAR)
across = np.array([-along[1], along[0]])
table = [*np.array([FAR, NEAR]) + across, *np.array([NEAR, FAR]) - across]
axes.add_patch(Polygon(table, closed=True, facecolor=WOOD, edgecolor="none"))
middle = np.add(NEAR, FAR) / 2
arrow(axes, tuple(middle - across), (middle[0], middle[1] - 8), colour=INK)
axes.text(middle[0] + 1.5, middle[1] - 6.5, "weight")

# The person: a hand on a spring and a damper, and a hinge that resists the pitch.
hand = 92.0
axes.plot([NEAR[0], hand], [NEAR[1], NEAR[1]], color=HUMAN, linewidth=5, solid_capstyle="round")
axes.plot([79, 97], [MEANT, MEANT], color=HUMAN, linewidth=1.6)
spring(axes, (83.5, NEAR[1]), MEANT)
damper(axes, (91.0, NEAR[1]), MEANT)
axes.text(81, 38.5, "$K$", ha="right", va="center")
axes.text(94, 38.5, "$B$", va="center")
axes.text(98, MEANT + 1.5, "intended height\nand reflexes: $r + \\rho$", color=HUMAN, ha="right")
axes.text(hand + 4, NEAR[1] - 2.2, "hands, $M$", color=HUMAN, ha="right", va="top")
axes.add_patch(Circle(NEAR, 1.8, facecolor="white", edgecolor=HUMAN, linewidth=1.8))
axes.text(NEAR[0] - 9, NEAR[1] + 3.4, "grip: a hinge\nwith a spring", ha="center", size=8)
arrow(axes, (NEAR[0], NEAR[1] - 11), (NEAR[0], NEAR[1] - 2.2), colour=HUMAN, linewidth=2.2)
axes.text(NEAR[0] - 1.5, NEAR[1] - 8.5, "force", color=HUMAN, ha="right")
height(axes, 80.0, NEAR[1] - 0.5, "$z$", HUMAN)

# The robot: joints that follow the command, and hands that are pinned to the table.
shoulder, elbow = (7.0, 38.0), (14.0, 25.0)
arm = [shoulder, elbow, FAR]
axes.plot(*zip(*arm, strict=True), color=ROBOT, linewidth=5, solid_capstyle="round")
axes.plot([7, 7], [REST, 44], color=LINE, linewidth=9, zorder=0, solid_capstyle="round")
for joint in (shoulder, elbow):
    axes.add_patch(Circle(joint, 1.6, facecolor="white", edgecolor=ROBOT, linewidth=1.8))
axes.add_patch(Circle(FAR, 1.8, facecolor=ROBOT, edgecolor=ROBOT))
axes.text(FAR[0] + 1, FAR[1] + 3.6, "hands: pinned", ha="center", size=8)
axes.text(12, 42, "joints: follow the command\nin 20 ms, sag under load", color=ROBOT, size=8)
arrow(axes, (FAR[0], FAR[1] - 11), (FAR[0], FAR[1] - 2.2), colour=ROBOT, linewidth=2.2)
axes.text(FAR[0] + 1.5, FAR[1] - 8.5, "force", color=ROBOT)
height(axes, 20.0, FAR[1] - 1.0, "$h$", ROBOT)
axes.text(3, 57, "robot", color=ROBOT, weight="bold", size=10)
axes.text(98, 57, "person", color=HUMAN, weight="bold", size=10, ha="right")
write(figure)
