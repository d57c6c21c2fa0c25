"""``colift row``: withdrawal, removal, reinstatement and rescoring of a board's rows."""

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Annotated

import typer
from colift.base.errors import InputError
from colift.benchmark.execution.pool import local_pool
from colift.benchmark.execution.progress import job_bar
from colift.cli.board_options import BOARD, ExistingBoard, SeasonName, Why, opened_board
from colift.cli.options import Jobs
from colift.leaderboard.core.board import LOCAL, Board
from colift.leaderboard.core.decisions import Decisions
from colift.leaderboard.core.standings import RankedRow
from colift.leaderboard.evaluation.progress import Callbacks
from colift.leaderboard.queue import WorkerQueue
from colift.leaderboard.queue.worker import Worker

app = typer.Typer(
    help="Change whether a row is ranked, or evaluate its submission again.",
    no_args_is_help=True,
)

RowName = Annotated[
    str,
    typer.Argument(
        metavar="ROW", help="The row's policy, or its submission's digest, or the digest's start."
    ),
]
DecidedBy = Annotated[
    str, typer.Option("--by", metavar="NAME", help="Person who decided; the name is public.")
]


def _decision(
    act: Callable[[Decisions, str, str, str, str], None], outcome: str, *, ranked: bool
) -> Callable[..., None]:
    """Return the command for a decision about a row that must be ranked, or must not."""

    def decide(
        row: RowName,
        why: Why,
        by: DecidedBy = LOCAL,
        season: SeasonName = None,
        board: ExistingBoard = BOARD,
    ) -> None:
        with _row_of(board, row, season) as (place, found):
            if (found.section == "out") == ranked:
                name = f"{found.row.name} in season {found.row.season}"
                state = "already out of" if ranked else "not out of"
                raise InputError(f"{name} is {state} the ranking")
            act(Decisions(place), found.row.season, found.row.submission, by, why)
        print(f"{found.row.name} is {outcome}")

    return decide


app.command(
    "withdraw",
    help="Take a row out of the ranking at its submitter's request; it stays visible.\n\n"
    "Example: colift row withdraw mine --why 'a better one is coming' --by Ada --board board",
)(_decision(Decisions.withdraw, "withdrawn", ranked=True))
app.command(
    "remove",
    help="Take a row out of the ranking as the maintainer; it stays visible.\n\n"
    "Example: colift row remove mine --why 'it read the clock' --by Ada --board board",
)(_decision(Decisions.remove, "removed from the ranking", ranked=True))
app.command(
    "reinstate",
    help="Return a withdrawn or removed row to the ranking.\n\n"
    "Example: colift row reinstate mine --why 'it did not' --by Ada --board board",
)(_decision(Decisions.reinstate, "reinstated", ranked=False))


@app.command()
def rescore(
    row: RowName,
    why: Why,
    by: DecidedBy = LOCAL,
    season: SeasonName = None,
    board: ExistingBoard = BOARD,
    jobs: Jobs = None,
) -> None:
    """Evaluate a row's submission again, for example after a run on an overloaded machine.

    Example: colift row rescore mine --why 'the machine was overloaded' --board board
    """
    with (
        _row_of(board, row, season) as (place, found),
        local_pool(jobs) as pool,
        job_bar(found.row.name, None) as bar,
    ):
        watch = Callbacks(stage=bar.stage, progress=bar.advance, total=bar.total)
        worker = Worker(WorkerQueue(place), pool)
        new = worker.rescore(found.row.season, found.row.submission, by, why, watch)
        place.standings(found.row.season)  # Computes the ranks before a reader looks.
    before, after = found.row.hidden.rmse_mm.mean, new.hidden.rmse_mm.mean
    print(f"{new.name} is rescored: hidden RMSE {after:.2f} mm, before {before:.2f} mm")


@contextmanager
def _row_of(folder: Path, text: str, season: str | None) -> Iterator[tuple[Board, RankedRow]]:
    """Open a board and find one of its rows by name, digest or the start of a digest."""
    with opened_board(folder) as board:
        info = board.season_info(season)
        rows = board.standings(info.name)
        found = [each for each in rows if text in (each.row.name, each.row.submission)]
        found = found or [each for each in rows if text and each.row.submission.startswith(text)]
        if len(found) != 1:
            known = (f"{each.row.name} {each.row.submission[:16]}" for each in found or rows)
            many = f"{len(found)} rows match" if found else "no row matches"
            raise InputError(
                f"season {info.name}: {many} {text!r}; rows: {', '.join(known) or 'none'}"
            )
        yield board, found[0]
