"""``colift new``: a submission to begin with."""

from pathlib import Path
from typing import Annotated

import typer

from ..agents.submissions.new import FILES, write_template


def new(
    folder: Annotated[Path, typer.Argument(metavar="DIR", help="A folder that is not there yet.")],
) -> None:
    """Write a working submission: a proportional controller, to change as you like."""
    write_template(folder)
    for name in FILES:
        print(f"wrote {folder / name}")
    print(f"Next: edit them, then colift check {folder}")
