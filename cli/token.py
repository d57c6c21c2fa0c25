"""``colift token``: who may submit to a board over the web."""

from pathlib import Path
from typing import Annotated

import typer
from rich import box
from rich.console import Console
from rich.table import Table

from ..leaderboard.board import Board
from ..leaderboard.tokens import Tokens

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
def list_all(board: BoardOption = Path("board")) -> None:
    """List who has a token, or had one."""
    table = Table("name", "since", "until", box=box.SIMPLE_HEAD)
    for each in Tokens(Board.open(board)).all():
        until = "" if each.revoked_at is None else f"{each.revoked_at:%Y-%m-%d}"
        table.add_row(each.name, f"{each.added_at:%Y-%m-%d}", until)
    Console().print(table)
