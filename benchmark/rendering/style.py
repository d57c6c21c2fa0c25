"""The common look of pictures: colours and axes, one colour for each end of the table.

Blue and vermillion are distinct with any kind of colour vision (M. Okabe and K. Ito, "Color
universal design", 2008).
"""

from collections.abc import Mapping
from typing import TYPE_CHECKING, Final

if TYPE_CHECKING:
    from matplotlib.axes import Axes

HUMAN: Final = "#0072B2"
ROBOT: Final = "#D55E00"
INK: Final = "#22262E"
FAINT: Final = "#6B7280"
LINE: Final = "#D7DBE0"
PAPER: Final = "#FFFFFF"
SKY: Final = "#EFF2F6"
AIM: Final = "#00805D"
PREDICTION: Final = "#009E73"
CONFIDENCE: Final = "#8A4F9E"

DASHES: Final = (0, (4, 3))
"""Line style of what is meant, or to be compared with."""
ROBOT_DASHES: Final = (0, (3.5, 1))
"""Line style of the robot's end, which tells it from the human's in print without colours."""


LOOKS: Final = (
    (ROBOT, "-", "o"),
    (PREDICTION, "--", "s"),
    (CONFIDENCE, "-.", "^"),
    (INK, ":", "D"),
    ("#E69F00", (0, (6, 1.5)), "v"),
    ("#56B4E9", (0, (1, 1)), "P"),
    (FAINT, (0, (3, 1, 1, 1, 1, 1)), "X"),
)
"""Colour, line and marker of lines in one picture, in this order; the human's colour is left to two
people."""

PEOPLE: Final = "two people"
"""Name of the human-human baseline in tables, in pictures and in print."""

COLOURS: Final[Mapping[str, str]] = {"human": HUMAN, "robot": ROBOT}
"""The colour of each end of the table."""


def rgba(colour: str) -> tuple[float, float, float, float]:
    """Return a colour ``#rrggbb`` as red, green, blue and opacity within 0 to 1."""
    red, green, blue = (int(colour[i : i + 2], 16) / 255 for i in (1, 3, 5))
    return red, green, blue, 1.0


def mixed(colour: str, other: str, share: float) -> tuple[float, float, float, float]:
    """Return a colour with another: ``share`` of the first, within 0 to 1."""
    red, green, blue = (
        share * one + (1 - share) * two
        for one, two in zip(rgba(colour)[:3], rgba(other)[:3], strict=True)
    )
    return red, green, blue, 1.0


def style_axes(axes: "Axes") -> None:
    """Give axes the common look."""
    axes.grid(color=LINE, linewidth=0.7)
    axes.set_axisbelow(True)
    axes.tick_params(colors=FAINT, length=0)
    for side in ("top", "left", "right"):
        axes.spines[side].set_visible(False)
    axes.spines["bottom"].set_color(LINE)
