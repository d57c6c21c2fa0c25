"""``colift render``: a lift as picture or film."""

from pathlib import Path
from typing import Annotated

import typer


def render(
    policy: Annotated[
        str, typer.Argument(help="A name of 'colift list', module:Class or file.py:Class.")
    ],
    out: Annotated[Path, typer.Option(metavar="FILE", help="FILE.gif, FILE.mp4 or FILE.png.")],
    scenario: Annotated[str, typer.Option(help="The human's behaviour.")] = "smooth",
) -> None:
    """Draw a lift, seen from the side, with the heights of both ends under it."""
