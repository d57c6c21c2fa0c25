"""``colift token``: the submitters of a board on the web."""

import csv
import sys
from typing import Annotated

import typer
from colift.benchmark.tables.printing import show, table
from colift.cli.board_options import BOARD, BoardFolder, ExistingBoard, opened_board
from colift.leaderboard.core.tokens import Tokens
from colift.leaderboard.practice.season_import import open_to_read

app = typer.Typer(
    help="Manage the tokens of the submitters of a board on the web.", no_args_is_help=True
)

Submitter = Annotated[str, typer.Argument(metavar="NAME", help="The submitter's name.")]


@app.command()
def add(
    names: Annotated[list[str], typer.Argument(metavar="NAME...", help="The submitters' names.")],
    board: BoardFolder = BOARD,
) -> None:
    """Create submitters' tokens and print them; they cannot be shown again.

    The token of one submitter is printed alone, those of several as CSV: name,token.

    Example: colift token add ada --board board
    """
    with opened_board(board, new=True) as opened:
        made = Tokens(opened).add_all(names)
    if len(names) == 1:
        print(made[names[0]])
        return
    rows = csv.writer(sys.stdout, lineterminator="\n")
    rows.writerow(("name", "token"))
    rows.writerows(made.items())


@app.command()
def revoke(name: Submitter, board: ExistingBoard = BOARD) -> None:
    """Revoke a submitter's token, effective at once.

    Example: colift token revoke ada --board board
    """
    with opened_board(board) as opened:
        Tokens(opened).revoke(name)
    print(f"the token of {name} is revoked")


@app.command("list")
def list_tokens(board: ExistingBoard = BOARD) -> None:
    """List the submitters, with the dates of their tokens.

    Example: colift token list --board board
    """
    with opened_board(board, open_to_read) as opened:
        found = Tokens(opened).all()
    rows = (
        (
            each.name,
            f"{each.added_at:%Y-%m-%d}",
            "" if each.revoked_at is None else f"{each.revoked_at:%Y-%m-%d}",
        )
        for each in found
    )
    show(table("", ("name", "since", "until"), rows))
