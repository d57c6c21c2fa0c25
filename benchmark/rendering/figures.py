"""Figures of matplotlib as files: PNG, SVG and PDF.

A figure is drawn once, within :func:`drawn_for`. All files hold the same picture. In SVG and PDF
text stays text, in a font that is named or embedded as TrueType. Equal figures give equal bytes,
whatever the day, the machine's fonts or its settings of matplotlib.
"""

import html
import io
import re
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any, Final

from colift.benchmark.rendering.layout import SUFFIXES, Layout
from colift.benchmark.rendering.style import FAINT, INK, LINE, PAPER, SKY
from matplotlib import style
from matplotlib.figure import Figure

DPI: Final = 300
"""Pixels per inch of a PNG."""

LOOK: Final[dict[str, Any]] = {
    "figure.facecolor": PAPER,
    "axes.titlesize": "medium",
    "axes.titlelocation": "left",
    "figure.titlesize": "medium",
    "text.color": INK,
    "axes.labelcolor": INK,
    "xtick.labelcolor": FAINT,
    "ytick.labelcolor": FAINT,
    "legend.frameon": False,
    "legend.borderaxespad": 0.3,
    "legend.handlelength": 1.8,
}

FILES: Final[dict[str, Any]] = {
    "font.sans-serif": ["DejaVu Sans", "Verdana", "Arial"],
    "svg.fonttype": "none",
    "svg.hashsalt": "colift",
    "pdf.fonttype": 42,
}

GREYS: Final = {INK.lower(): 1.0, FAINT.lower(): 0.7, LINE.lower(): 0.2, SKY.lower(): 0.07}
"""Opacity of the text's colour in place of each grey."""

NAMELESS: Final[dict[str, dict[str, None]]] = {
    ".png": {"Software": None},
    ".svg": {"Creator": None, "Date": None},
    ".pdf": {"Creator": None, "Producer": None, "CreationDate": None},
}
"""What matplotlib would write into a file: names, versions and dates, which differ between runs."""


@contextmanager
def drawn_for(layout: Layout) -> Iterator[None]:
    """Draw figures in the common look, with the letters of a layout.

    Within this context the settings of matplotlib are its defaults, and not those of a user's file.
    """
    size: dict[str, Any] = {"font.size": layout.letters}
    with style.context(["default", {**LOOK, **size}]):
        yield


def neutral_svg(figure: Figure, title: str) -> str:
    """Return a figure as an SVG element of a page, light or dark: its greys are those of the text.

    The title is read to those who do not see the figure. It also makes the names of the figure's
    parts unique on the page.
    """
    buffer = io.StringIO()
    with style.context(["default", {**FILES, "svg.hashsalt": title}]):
        figure.savefig(buffer, format="svg", transparent=True, metadata=NAMELESS[".svg"])
    text = buffer.getvalue()
    text = re.sub("(fill|stroke): (#[0-9a-f]{6})", _neutral, text[text.index("<svg") :])
    label = html.escape(title)
    return text.replace(
        "<svg ", f'<svg role="img" aria-label="{label}" style="max-width: 100%; height: auto" ', 1
    )


def _neutral(colour: re.Match[str]) -> str:
    """Return a colour of SVG; a grey is that of the text, faint, and white is nothing."""
    part, value = colour.groups()
    if value == PAPER.lower():
        return f"{part}: none"
    if value not in GREYS:
        return colour[0]
    return f"{part}: currentColor; {part}-opacity: {GREYS[value]}"


def figure_bytes(figure: Figure, suffix: str, title: str) -> bytes:
    """Return a figure as the content of a file.

    Parameters
    ----------
    figure
        The figure.
    suffix
        One of :data:`SUFFIXES`.
    title
        Content of the figure in a line, which readers of the file show.
    """
    buffer = io.BytesIO()
    with style.context(["default", FILES]):
        figure.savefig(
            buffer,
            format=suffix.removeprefix("."),
            dpi=DPI,
            metadata={**NAMELESS[suffix], "Title": title},
        )
    return buffer.getvalue()


def write_figure(path: Path, figure: Figure, title: str) -> None:
    """Write a figure to a file, in the format of its suffix; see :func:`figure_bytes`."""
    path.write_bytes(figure_bytes(figure, path.suffix, title))


def write_all(folder: Path, name: str, figure: Figure, title: str) -> None:
    """Write a figure into a folder in every format."""
    for suffix in SUFFIXES:
        write_figure(folder / f"{name}{suffix}", figure, title)
