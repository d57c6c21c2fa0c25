"""``colift board``: a board's tables in the terminal."""

import json
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Annotated, Any

import typer
from rich.console import Console

from ..agents.errors import InputError
from ..leaderboard.backup.backup import Backup, back_up
from ..leaderboard.backup.restoring import restore
from ..leaderboard.board.board import Board
from ..leaderboard.pages.site import write_site
from ..leaderboard.practice.shipped import open_to_read
from ..leaderboard.queue import Queue
from ..leaderboard.records.season import SeasonInfo
from .printing import show
from .tables.board import board_table


def board(
    board: Annotated[
        Path, typer.Option(metavar="PATH", help="The board's folder; made if there is none.")
    ] = Path("board"),
    season: Annotated[
        str | None, typer.Option(metavar="NAME", help="Which season; default: the current one.")
    ] = None,
    as_json: Annotated[
        bool, typer.Option("--json", help="Print the table as JSON, and nothing else.")
    ] = False,
    site: Annotated[
        Path | None,
        typer.Option(
            metavar="DIR", help="Write the pages of all seasons as files, to open or host."
        ),
    ] = None,
    backup: Annotated[
        Path | None,
        typer.Option(metavar="FILE", help="Write the whole board, in use or not, into one file."),
    ] = None,
    from_backup: Annotated[
        Path | None,
        typer.Option(
            "--restore", metavar="FILE", help="Make the board of a backup at PATH, a new folder."
        ),
    ] = None,
) -> None:
    """Print a board: rank groups, RMSE with its interval, and the human-human team's line."""
    asked = [name for name, value in _options(site, as_json, backup, from_backup) if value]
    if len(asked) > 1:
        raise InputError(f"{' and '.join(asked)} exclude each other")
    if from_backup is not None:
        told = restore(from_backup, board)
        _tell(told, f"restored {from_backup} to {board}")
        print(f"Next: colift board --board {board}")
        return
    place = open_to_read(board)
    try:
        if backup is not None:
            _tell(back_up(place, backup), f"backed up {board} to {backup}")
            print("It holds the secrets of the seasons: keep it to yourself.")
        elif site is not None:
            write_site(place, site)
            print(f"Open {(site / 'index.html').absolute().as_uri()}")
        elif as_json:
            print(json.dumps(_content(place, season), indent=2, allow_nan=False))
        else:
            _show(place, season)
    finally:
        place.close()


def _options(
    site: Path | None, as_json: bool, backup: Path | None, from_backup: Path | None
) -> Iterator[tuple[str, object]]:
    yield "--site", site
    yield "--json", as_json
    yield "--backup", backup
    yield "--restore", from_backup


def _tell(told: Backup, done: str) -> None:
    print(f"{done}: {told.seasons} seasons, {told.entries} entries, {told.jobs} jobs")
    for each in told.missing:
        print(f"missing: {each}", file=sys.stderr)


def _show(place: Board, season: str | None) -> None:
    console, info = Console(), place.season_info(season)
    standings, team = place.standings(info.name), place.team(info.name)
    show(board_table(info, standings, team, console.width), console=console)
    for each in place.events(info.name):
        if each.submission is not None:
            what = f"{each.kind} of {each.submission[:16]} by {each.who}"
            print(f"{each.at:%Y-%m-%d} {what}: {each.why}")
    others = [each.name for each in place.seasons() if each.name != info.name]
    if others:
        print(f"Other seasons: {', '.join(others)} (--season NAME)")
    if info.current:
        print(_waiting(place))


def _waiting(place: Board) -> str:
    open_jobs = [job for job in Queue(place).jobs() if not job.ended]
    if not open_jobs:
        return "Nothing waits. Submit by: colift submit DIR --board PATH"
    told = ", ".join(f"{job.name} ({job.state})" for job in open_jobs[:5])
    return f"{len(open_jobs)} in the queue: {told}"


def _content(place: Board, season: str | None) -> dict[str, Any]:
    info: SeasonInfo = place.season_info(season)
    team = place.team(info.name)
    return {
        "season": {**vars(info), "began_at": info.began_at.isoformat()},
        "human_human": None
        if team is None
        else {
            "rmse_mm": {"mean": team.rmse_mm.mean, "ci95": list(team.rmse_mm.ci95)},
            **team.means,
        },
        "rows": [
            {
                "section": each.section,
                "group": each.group,
                "at": each.at.isoformat(),
                "submitter": each.submitter,
                "row": each.row.plain(),
                "events": [event.plain() for event in each.events],
            }
            for each in place.standings(info.name)
        ],
    }
