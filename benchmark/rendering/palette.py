"""Colours and letters of a picture. One colour for each end of the table, in scene and curves.

Blue and vermillion are told apart with any kind of colour vision (M. Okabe and K. Ito, "Color
universal design", 2008).
"""

from functools import cache
from pathlib import Path
from typing import Final

import matplotlib
from PIL import ImageFont

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


@cache
def letters(size: int, *, bold: bool = False) -> ImageFont.FreeTypeFont:
    """Return DejaVu Sans, which comes with matplotlib, in a size [pixels]."""
    name = "DejaVuSans-Bold.ttf" if bold else "DejaVuSans.ttf"
    return ImageFont.truetype(Path(matplotlib.get_data_path(), "fonts", "ttf", name), size)
