"""The look of the board for this site: its icon, its fonts and its colours, as Furo names them."""

import re
from collections.abc import Mapping
from pathlib import Path
from typing import Final

STATIC: Final = Path(__file__).parents[2] / "leaderboard" / "static"

ICON: Final = STATIC / "icon.svg"

COLOURS: Final[Mapping[str, str]] = {
    "color-brand-primary": "accent",
    "color-brand-content": "accent",
    "color-brand-visited": "accent",
    "color-background-primary": "paper",
    "color-background-secondary": "card",
    "color-background-border": "line",
    "color-foreground-primary": "ink",
    "color-foreground-secondary": "faint",
    "color-foreground-muted": "faint",
}
"""Variables of Furo, each with the variable of the board that has its meaning."""

FONTS: Final[Mapping[str, str]] = {"font-stack": "font", "font-stack--monospace": "mono"}


def read_variables(scheme: int) -> dict[str, str]:
    """Return Furo's variables in a scheme of the board: 0 is the light one, 1 the dark one."""
    style = (STATIC / "board.css").read_text(encoding="utf-8")
    blocks = [
        dict(re.findall(r"--([\w-]+):\s*([^;]+);", block))
        for block in re.findall(r":root\s*\{(.*?)\}", style, re.DOTALL)
    ]
    known = blocks[0] | blocks[scheme]
    return {name: known[own] for name, own in (COLOURS | FONTS).items()}
