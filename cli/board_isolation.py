"""The option ``--isolation`` of a board's workers, and what they say of it when they start."""

import sys
from typing import Annotated

import typer

from ..agents.sandbox.host.levels import VERIFIABLE
from ..leaderboard.evaluation.entrant import NoSandboxError, board_level

Isolation = Annotated[
    str,
    typer.Option(
        help="What keeps submissions apart: auto (the strongest that can be verified; where there "
        "is none, nothing is evaluated), bubblewrap, landlock, or limits (no sandbox: rows are not "
        "verified and have no rank)."
    ),
]


def tell_isolation(isolation: str) -> None:
    """Say on stderr how submissions will be kept apart, and why not in a stronger way.

    Raises
    ------
    InputError
        If there is no isolation of that name.
    """
    try:
        choice = board_level(isolation)
    except NoSandboxError as error:
        print(
            f"submissions are not evaluated here: {error}\n"
            "They wait, and it is tried again every minute. To evaluate them without a sandbox, "
            "for rows that are not verified and have no rank: --isolation limits",
            file=sys.stderr,
            flush=True,
        )
        return
    told = "" if choice.level in VERIFIABLE else "; no sandbox: rows are not verified, not ranked"
    print(f"{choice}{told}", file=sys.stderr, flush=True)
