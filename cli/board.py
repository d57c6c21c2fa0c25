"""``colift board``: a board's tables in the terminal."""

import json
from pathlib import Path
from typing import Annotated, Any

import typer
from rich.console import Console
from rich.text import Text

from ..leaderboard.board import Board
from ..leaderboard.opening import open_stocked
from ..leaderboard.pages.site import write_site
from ..leaderboard.queue import Queue
from ..leaderboard.season import SeasonInfo
from .board_table import board_table


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
) -> None:
    """Print a board: rank groups, RMSE with its interval, and the human-human team's line."""
    place = open_stocked(board)
    try:
        if site is not None:
            write_site(place, site)
            print(f"Open {(site / 'index.html').absolute().as_uri()}")
        elif as_json:
            print(json.dumps(_content(place, season), indent=2, allow_nan=False))
        else:
            _show(place, season)
    finally:
        place.close()


def _show(place: Board, season: str | None) -> None:
    console, info = Console(), place.season_info(season)
    table = board_table(info, place.standings(info.name), place.team(info.name), console.width)
    console.print(table)
    for each in place.events(info.name):
        if each.submission is not None:
            what = f"{each.kind} of {each.submission[:16]} by {each.who}"
            console.print(Text(f"{each.at:%Y-%m-%d} {what}: {each.why}"), soft_wrap=True)
    others = [each.name for each in place.seasons() if each.name != info.name]
    if others:
        console.print(Text(f"Other seasons: {', '.join(others)} (--season NAME)"), soft_wrap=True)
    if info.current:
        console.print(Text(_waiting(place)), soft_wrap=True)


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
            "sparc": team.sparc,
            "human_force_n": team.human_force_n,
        },
        "rows": [
            {
                "group": each.group,
                "at": each.at.isoformat(),
                "submitter": each.submitter,
                "row": each.row.plain(),
                "events": [event.plain() for event in each.events],
            }
            for each in place.standings(info.name)
        ],
    }
