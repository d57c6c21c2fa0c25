"""``colift new``: a submission to begin with."""

from pathlib import Path
from typing import Annotated

import typer

from ..agents.submissions.new import FILES, write_template
from .arguments import argument


def new(
    folder: Annotated[Path, typer.Argument(metavar="DIR", help="A new folder, or an empty one.")],
) -> None:
    """Write a working submission: a proportional controller, to change as you like.

    policy.py is the policy, one class; policy.toml says who wrote it and what it needs.
    """
    write_template(folder)
    for name in FILES:
        print(f"wrote {folder / name}")
    print(f"Next: edit them, then colift check {argument(folder)}")
