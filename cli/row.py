"""``colift row``: withdrawal, removal, reinstatement and rescoring of a board's rows."""

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Annotated

import typer

from ..agents.errors import InputError
from ..benchmark.execution.pool import local_pool
from ..leaderboard.board.board import LOCAL, Board
from ..leaderboard.board.standings import RankedRow
from ..leaderboard.evaluation.progress import Callbacks
from ..leaderboard.practice.shipped import open_stocked
from ..leaderboard.queue import WorkerQueue
from ..leaderboard.queue.worker import Worker
from .options import Jobs
from .progress import job_bar

app = typer.Typer(
    help="Take a row out of the ranking or back into it, or evaluate it again.",
    no_args_is_help=True,
)

RowArgument = Annotated[
    str, typer.Argument(metavar="ROW", help="Policy name or digest of a row, or its beginning.")
]
WhyOption = Annotated[str, typer.Option("--why", help="The reason, for everybody to read.")]
ByOption = Annotated[
    str, typer.Option("--by", metavar="NAME", help="Who decided it, for everybody to read.")
]
SeasonOption = Annotated[
    str | None, typer.Option("--season", metavar="NAME", help="Season; default: the current one.")
]
BoardOption = Annotated[Path, typer.Option("--board", metavar="PATH", help="The board's folder.")]


@app.command()
def withdraw(
    row: RowArgument,
    why: WhyOption,
    by: ByOption = LOCAL,
    season: SeasonOption = None,
    board: BoardOption = Path("board"),
) -> None:
    """Take a row out of the ranking at its submitter's request; it stays visible."""
    with _row_of(board, row, season, out=False) as (place, found):
        place.withdraw(found.row.season, found.row.submission, by, why)
    print(f"{found.row.name} is withdrawn")


@app.command()
def remove(
    row: RowArgument,
    why: WhyOption,
    by: ByOption = LOCAL,
    season: SeasonOption = None,
    board: BoardOption = Path("board"),
) -> None:
    """Take a row out of the ranking at the maintainer's request; it stays visible."""
    with _row_of(board, row, season, out=False) as (place, found):
        place.remove(found.row.season, found.row.submission, by, why)
    print(f"{found.row.name} is removed from the ranking")


@app.command()
def reinstate(
    row: RowArgument,
    why: WhyOption,
    by: ByOption = LOCAL,
    season: SeasonOption = None,
    board: BoardOption = Path("board"),
) -> None:
    """Take a withdrawn or removed row back into the ranking."""
    with _row_of(board, row, season, out=True) as (place, found):
        place.reinstate(found.row.season, found.row.submission, by, why)
    print(f"{found.row.name} is reinstated")


@app.command()
def rescore(
    row: RowArgument,
    why: WhyOption,
    by: ByOption = LOCAL,
    season: SeasonOption = None,
    board: BoardOption = Path("board"),
    jobs: Jobs = None,
) -> None:
    """Evaluate a row's submission again, such as after a run on an overloaded machine."""
    with (
        _row_of(board, row, season) as (place, found),
        local_pool(jobs) as pool,
        job_bar(found.row.name, None) as bar,
    ):
        watch = Callbacks(stage=bar.stage, progress=bar.advance, total=bar.total)
        worker = Worker(WorkerQueue(place), pool)
        new = worker.rescore(found.row.season, found.row.submission, by, why, watch)
    before, after = found.row.hidden.rmse_mm.mean, new.hidden.rmse_mm.mean
    print(f"{new.name} is rescored: hidden RMSE {after:.2f} mm, before {before:.2f} mm")


@contextmanager
def _row_of(
    folder: Path, text: str, season: str | None, *, out: bool | None = None
) -> Iterator[tuple[Board, RankedRow]]:
    """Open a board and find one of its rows, in or out of the ranking if that is asked for."""
    place = open_stocked(folder)
    try:
        info = place.season_info(season)
        rows = place.standings(info.name)
        found = [each for each in rows if text in (each.row.name, each.row.submission)]
        found = found or [each for each in rows if text and each.row.submission.startswith(text)]
        if len(found) != 1:
            told = ", ".join(
                f"{each.row.name} {each.row.submission[:16]}" for each in found or rows
            )
            many = f"{len(found)} rows match" if found else "no row matches"
            raise InputError(f"season {info.name}: {many} {text!r}; rows: {told or 'none'}")
        if out is not None and (found[0].section == "out") != out:
            state = "not out of" if out else "already out of"
            raise InputError(f"{found[0].row.name} in season {info.name} is {state} the ranking")
        yield place, found[0]
    finally:
        place.close()
