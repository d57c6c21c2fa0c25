"""Sizes of figures: a column or the width of a page in print, or a slide."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Final

from colift.base.errors import InputError
from colift.base.near_names import did_you_mean


@dataclass(frozen=True, kw_only=True)
class Layout:
    """The size of a figure, at which its letters are as large as those around it."""

    name: str
    width: float
    """[inches]"""
    height: float | None = None
    """[inches]; None if a figure is as high as its content."""
    letters: float
    """Size of letters [points]."""

    @property
    def narrow(self) -> bool:
        """Whether panels stand below each other."""
        return self.width < 5.0

    def size(self, height: float) -> tuple[float, float]:
        """Return width and height [inches] of a figure whose content asks for a height."""
        return self.width, self.height or height


COLUMN: Final = Layout(name="column", width=3.5, letters=8.0)
"""A column of a page with two, as in the IEEE's journals."""

PAGE: Final = Layout(name="page", width=7.0, letters=8.0)
"""Both columns."""

SLIDE: Final = Layout(name="slide", width=6.3, height=3.54375, letters=10.0)
"""A slide of 16:9 in the size of LaTeX's beamer, 160 x 90 mm. On the 13.3 inches of other programs,
where a figure is enlarged with its letters, these have 21 points."""

VECTOR: Final = (".svg", ".pdf")
SUFFIXES: Final = (".png", *VECTOR)
"""Suffixes of the files of a figure."""

LAYOUTS: Final[Mapping[str, Layout]] = {each.name: each for each in (COLUMN, PAGE, SLIDE)}


def find_layout(name: str) -> Layout:
    """Return a layout by its name.

    Raises
    ------
    InputError
        If there is none.
    """
    if name not in LAYOUTS:
        near = did_you_mean(name, LAYOUTS)
        raise InputError(f"no figures for {name!r}; {near}known: {', '.join(LAYOUTS)}")
    return LAYOUTS[name]
