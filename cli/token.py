"""``colift token``: who may submit to a board over the web."""

from pathlib import Path
from typing import Annotated

import typer

from ..leaderboard.board.board import Board
from ..leaderboard.board.tokens import Tokens
from ..leaderboard.practice.shipped import open_to_read
from .printing import show, table

app = typer.Typer(help="Say who may submit to a board over the web.", no_args_is_help=True)

BoardOption = Annotated[Path, typer.Option("--board", metavar="PATH", help="The board's folder.")]
NameArgument = Annotated[str, typer.Argument(metavar="NAME", help="Of who submits.")]


@app.command()
def add(name: NameArgument, board: BoardOption = Path("board")) -> None:
    """Make a token for somebody, and print it; it is shown now and never again."""
    print(Tokens(Board.open(board)).add(name))


@app.command()
def revoke(name: NameArgument, board: BoardOption = Path("board")) -> None:
    """Make somebody's token worthless, at once."""
    Tokens(Board.open(board)).revoke(name)
    print(f"the token of {name} counts no more")


@app.command("list")
def list_tokens(board: BoardOption = Path("board")) -> None:
    """List who has a token, or had one."""
    place = open_to_read(board)
    try:
        found = Tokens(place).all()
    finally:
        place.close()
    rows = (
        (
            each.name,
            f"{each.added_at:%Y-%m-%d}",
            "" if each.revoked_at is None else f"{each.revoked_at:%Y-%m-%d}",
        )
        for each in found
    )
    show(table("", ("name", "since", "until"), rows))
