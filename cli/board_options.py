"""Options and opening of boards, shared by the commands of submitters and maintainers."""

import re
import sys
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Annotated, Final

import sqlalchemy as sa
import typer
from colift.agents.sandbox.host.levels import VERIFIABLE
from colift.base.errors import EvaluatorFault, InputError
from colift.leaderboard.core.board import Board
from colift.leaderboard.database.connection import DatabaseAwayError
from colift.leaderboard.database.room import NoRoomError, is_full
from colift.leaderboard.evaluation.entrant import NoSandboxError, board_level
from colift.leaderboard.practice.season_import import open_with_practice
from colift.leaderboard.storage.store import has_board

BOARD: Final = Path("board")
"""The default folder."""

AWAY_S: Final = 1.0
"""Time between two attempts to reach a database that is away [s]."""

_WEB: Final = re.compile(r"(https?):/+(.*)", re.IGNORECASE)
"""Pattern of an address, also without the second slash, which a path does not keep."""

_HOST: Final = re.compile(r"([\w-]+(\.[\w-]+)*|\[[\da-fA-F:]+\]):\d{1,5}(/.*)?")
"""Pattern of an address without ``http://``."""


def web_address(text: str) -> str | None:
    """Return the address that a text is, or that it is without ``http://``; None for a folder."""
    found = _WEB.fullmatch(text)
    if found is not None:
        return f"{found[1].lower()}://{found[2]}"
    return f"http://{text}" if _HOST.fullmatch(text) and not Path(text).exists() else None


def _folder(value: Path) -> Path:
    """Return the folder of a board; refuse an address."""
    address = web_address(str(value))
    if address is not None:
        raise InputError(
            f"--board must be the folder of a board, got the address {address}: open it in a "
            f"browser, or use its JSON interface, see {address.rstrip('/')}/api; of the commands, "
            "only 'colift submit' takes an address"
        )
    return value


ExistingBoard = Annotated[
    Path,
    typer.Option(
        "--board",
        metavar="PATH",
        help="The board's folder.",
        callback=_folder,
    ),
]
BoardFolder = Annotated[
    Path,
    typer.Option(
        "--board",
        metavar="PATH",
        help="The board's folder, created if missing.",
        callback=_folder,
    ),
]
SeasonName = Annotated[
    str | None, typer.Option("--season", metavar="NAME", help="Season; default: the current one.")
]
LONGEST_TITLE: Final = 60
"""Longest name of a board [characters]: a phone shows it in two lines."""


def _title(text: str) -> str:
    """Return the name of a board; refuse one that does not fit in the head of a page."""
    if not (0 < len(text) <= LONGEST_TITLE and text.isprintable() and text.strip() == text):
        raise InputError(
            f"--title must be 1 to {LONGEST_TITLE} letters on one line, without spaces around "
            f"them, got {text!r:.80}"
        )
    return text


Title = Annotated[
    str,
    typer.Option(
        "--title",
        metavar="TEXT",
        help="Name of the board on its pages, such as that of a course.",
        callback=_title,
    ),
]
Why = Annotated[str, typer.Option("--why", metavar="TEXT", help="The reason; it is public.")]
BoardIsolation = Annotated[
    str,
    typer.Option(
        "--isolation",
        metavar="LEVEL",
        help="Isolation of the submissions: auto (the strongest level that can be verified; "
        "without one, submissions wait), bubblewrap, landlock, or limits (no sandbox: rows are "
        "neither verified nor ranked).",
    ),
]


@contextmanager
def opened_board(
    folder: Path, opening: Callable[[Path], Board] = open_with_practice, *, new: bool = False
) -> Iterator[Board]:
    """Open the board in a folder while the body runs; see :func:`.open_with_practice`.

    Parameters
    ----------
    folder, opening
        The folder, and what opens it.
    new
        Whether the board is made if there is none.

    Raises
    ------
    InputError
        If there is no board and none is to be made, or as :meth:`.Board.open`.
    EvaluatorFault
        If its disk is full, or its database fails.
    """
    if not new and not has_board(folder):
        raise InputError(
            f"there is no board in {folder}: check --board; 'colift submit', 'serve', 'worker', "
            "'token add' and 'season begin' make a new one"
        )
    board = opening(folder)
    try:
        yield board
    except (OSError, sa.exc.DBAPIError) as error:
        if is_full(error, folder):
            raise NoRoomError(folder) from error
        if isinstance(error, OSError):
            raise
        raise EvaluatorFault(f"the board's database does not work: {error.orig}") from error
    finally:
        board.close()


def open_patiently(folder: Path) -> Board:
    """Open a board as :func:`.open_with_practice`; wait for a database server that is away.

    The reason of the wait is printed on stderr, once.
    """
    told = ""
    while True:
        try:
            return open_with_practice(folder)
        except DatabaseAwayError as away:
            if str(away) != told:
                told = str(away)
                shown = " ".join(told.split())
                print(f"waiting for the database: {shown}", file=sys.stderr, flush=True)
            time.sleep(AWAY_S)


def report_isolation(isolation: str) -> None:
    """Report on stderr how submissions are isolated, and why no stronger level is used.

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
            "They wait, and the sandboxes are tried again every minute. To evaluate them without a "
            "sandbox, for rows that are not verified and have no rank: --isolation limits",
            file=sys.stderr,
            flush=True,
        )
        return
    note = "" if choice.level in VERIFIABLE else "; no sandbox: rows are not verified, not ranked"
    print(f"{choice}{note}", file=sys.stderr, flush=True)
