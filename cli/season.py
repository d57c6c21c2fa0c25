"""``colift season``: the seasons of a board."""

from pathlib import Path
from typing import Annotated

import typer

from ..leaderboard.board.board import LOCAL
from ..leaderboard.evaluation.entrant import builtin_entrant, builtin_names
from ..leaderboard.practice.shipped import open_stocked
from ..leaderboard.queue import Queue

app = typer.Typer(help="Begin and end the seasons of a board.", no_args_is_help=True)

BoardOption = Annotated[
    Path, typer.Option("--board", metavar="PATH", help="The board's folder; made if there is none.")
]
NameArgument = Annotated[str, typer.Argument(metavar="NAME", help="Of the season.")]


@app.command()
def begin(
    name: NameArgument,
    board: BoardOption = Path("board"),
    suite: Annotated[
        str | None, typer.Option(help="Scenario suite; default: that of the last season.")
    ] = None,
    own: Annotated[
        bool, typer.Option(help="Queue the project's own policies, to compare with.")
    ] = True,
) -> None:
    """Begin a season with a new secret; the rows so far stay, in a table of their own."""
    place = open_stocked(board)
    try:
        season = place.new_season(name, suite)
        print(f"season {name} on {season.suite.name} takes submissions from now on")
        print(f"commitment to its secret: {season.commitment}")
        if own:
            jobs = [Queue(place).enqueue_own(builtin_entrant(each)) for each in builtin_names()]
            print(f"{len(jobs)} policies of the project are queued")
            print(f"Next: colift worker --board {board} --once")
    finally:
        place.close()


@app.command()
def reveal(
    name: NameArgument,
    why: Annotated[str, typer.Option(help="Why, for everybody to read.")] = "the season is over",
    board: BoardOption = Path("board"),
) -> None:
    """Publish the secret of a season that is over: anybody can then play its hidden lifts."""
    place = open_stocked(board)
    try:
        place.reveal(name, LOCAL, why)
        print(f"the secret of season {name}: {place.season_info(name).revealed}")
    finally:
        place.close()
