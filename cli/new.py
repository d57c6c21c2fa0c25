"""``colift new``: a submission to begin with."""

from pathlib import Path
from typing import Annotated

import typer

from ..agents.submissions.from_file import write_from
from ..agents.submissions.new import FILES, write_template
from .printing import argument


def new(
    folder: Annotated[Path, typer.Argument(metavar="DIR", help="A new folder, or an empty one.")],
    source: Annotated[
        str | None,
        typer.Option(
            "--from",
            metavar="FILE.py:Class",
            help="Take this policy, with parameters after a comma if any, instead of the template.",
        ),
    ] = None,
) -> None:
    """Write a working submission: a proportional controller, to change as you like.

    policy.py is the policy, one class; policy.toml says who wrote it and what it needs. With --from
    they are what colift run FILE.py:Class,name=value runs.
    """
    if source is None:
        write_template(folder)
    else:
        write_from(folder, source)
    for name in FILES:
        print(f"wrote {folder / name}")
    told = "edit them" if source is None else "say in policy.toml who wrote it"
    print(f"Next: {told}, then colift check {argument(folder)}")
