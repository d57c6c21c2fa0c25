"""The five numbers of the robot's observation, on the picture of a lift."""

from contextlib import closing

from colift.agents.agent import RobotObservation
from colift.benchmark.rendering.scene import Scene
from colift.benchmark.rendering.style import FAINT, HUMAN, INK, ROBOT
from sheet import WIDTH, arrow, plt, write

SIZE = 1000, 760
"""Size of the picture [pixels]; all places below are in it."""
LEFT, RIGHT, TOP, BOTTOM = 110, 900, 10, 560
"""The part that is shown."""
REST = 400
"""The table's rest height."""

ROWS = {
    RobotObservation.HUMAN_END: ("motion capture, 100 ms old", HUMAN),
    RobotObservation.ROBOT_END: ("motion capture, 100 ms old", ROBOT),
    RobotObservation.HAND_HEIGHT: ("the hand's encoders, now", ROBOT),
    RobotObservation.HAND_COMMAND: ("the hand's command, now", INK),
    RobotObservation.TIME: ("since the lift began", INK),
}
PLACES = {
    RobotObservation.HUMAN_END: (585, 318),
    RobotObservation.ROBOT_END: (330, 338),
    RobotObservation.HAND_HEIGHT: (190, 345),
    RobotObservation.HAND_COMMAND: (150, 325),
}

with closing(Scene("nao")) as scene:
    scene.pose(0.19, 0.13)
    picture = scene.picture(*SIZE)

figure = plt.figure(figsize=(WIDTH, WIDTH * (BOTTOM - TOP) / (RIGHT - LEFT)))
axes = figure.add_axes((0.0, 0.0, 1.0, 1.0))
axes.imshow(picture, interpolation="none")
axes.set(xlim=(LEFT, RIGHT), ylim=(BOTTOM, TOP))
axes.axis("off")
axes.plot([LEFT + 10, 690], [REST, REST], color=FAINT, linewidth=1, linestyle=(0, (4, 3)))
axes.text(470, REST + 8, "rest height: 0 m", color=FAINT, va="top", ha="center", size=8)


def number(place: int, x: float, y: float, colour: str) -> None:
    """Draw the index of a number in a circle."""
    ring = {"boxstyle": "circle,pad=0.25", "facecolor": "white", "edgecolor": colour}
    axes.text(x, y, f"{place}", color=colour, weight="bold", ha="center", va="center", bbox=ring,
              size=8.5)  # fmt: skip


for place, (x, y) in PLACES.items():
    colour = ROWS[place][1]
    arrow(axes, (x, REST), (x, y), colour=colour, arrowstyle="<|-|>", linewidth=1.2)
    number(place, x, REST + 26, colour)
for row, (place, (words, colour)) in enumerate(ROWS.items()):
    y = 36 + 34 * row
    number(place, 135, y, colour)
    axes.text(158, y, place.name, color=colour, weight="bold", va="center", size=8.5)
    axes.text(362, y, words, va="center", size=8.5)
write(figure)
