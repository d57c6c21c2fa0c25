"""Colours of a picture. One colour for each end of the table, in scene and curves.

Blue and vermillion are told apart with any kind of colour vision (M. Okabe and K. Ito, "Color
universal design", 2008).
"""

from typing import Final

HUMAN: Final = "#0072B2"
ROBOT: Final = "#D55E00"
INK: Final = "#22262E"
FAINT: Final = "#6B7280"
LINE: Final = "#D7DBE0"
PAPER: Final = "#FFFFFF"
SKY: Final = "#EFF2F6"


def rgba(colour: str) -> tuple[float, float, float, float]:
    """Return a colour ``#rrggbb`` as red, green, blue and opacity within 0 to 1."""
    red, green, blue = (int(colour[i : i + 2], 16) / 255 for i in (1, 3, 5))
    return red, green, blue, 1.0
