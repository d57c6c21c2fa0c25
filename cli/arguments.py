"""How a next step is told, so that it can be typed as it stands."""

import shlex
from pathlib import Path

from ..agents.registry import POLICIES, entries


def argument(path: Path) -> str:
    """Return a file or folder as an argument of a command: quoted, and no policy's name."""
    shown = str(path)
    if shown in entries(POLICIES) or shown.startswith("-"):
        shown = f"./{shown}"
    return shlex.quote(shown)
