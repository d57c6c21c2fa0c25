"""``colift board``: a board's table in the terminal, its pages as files, and its backup."""

import sys
from pathlib import Path
from typing import Annotated, Any

import typer
from colift.base.errors import InputError
from colift.benchmark.results.summary import plain_estimate
from colift.benchmark.tables.printing import show, stdout_console
from colift.cli.board_options import BOARD, ExistingBoard, SeasonName, Title, opened_board
from colift.cli.document import print_json
from colift.cli.options import AsJson, check_exclusive
from colift.cli.tables.board import board_table
from colift.leaderboard.backup.restoring import restore
from colift.leaderboard.backup.writing import Backup, back_up
from colift.leaderboard.core.board import Board
from colift.leaderboard.pages.site import write_site
from colift.leaderboard.practice.season_import import open_to_read
from colift.leaderboard.queue import Queue
from colift.leaderboard.records.season import SeasonInfo
from colift.leaderboard.views.exports import standings_plain
from colift.leaderboard.views.page import NAME


def board(
    board: ExistingBoard = BOARD,
    season: SeasonName = None,
    as_json: AsJson = False,
    site: Annotated[
        Path | None,
        typer.Option(metavar="DIR", help="Write the pages of all seasons, to open or to host."),
    ] = None,
    title: Title = NAME,
    backup: Annotated[
        Path | None,
        typer.Option(metavar="FILE", help="Write the whole board to one file, even while in use."),
    ] = None,
    from_backup: Annotated[
        Path | None,
        typer.Option(
            "--restore", metavar="FILE", help="Restore a backup into the folder of --board."
        ),
    ] = None,
) -> None:
    """Print a board's table: ranks, RMSE with its interval, and two people.

    Example: colift board --board board
    """
    check_exclusive(json=as_json, site=site, backup=backup, restore=from_backup)
    if title != NAME and site is None:
        raise InputError("--title belongs to --site: it is the name on the pages")
    if from_backup is not None:
        _report(restore(from_backup, board), f"restored {from_backup} to {board}")
        print(f"Next: colift board --board {board}")
        return
    # The default folder is for a first look at the practice season.
    with opened_board(board, open_to_read, new=board == BOARD) as opened:
        if backup is not None:
            _report(back_up(opened, backup), f"backed up {board} to {backup}")
            print("It holds the secrets of the seasons: keep it to yourself.")
        elif site is not None:
            write_site(opened, site, title)
            print(f"Open {(site / 'index.html').absolute().as_uri()}")
        elif as_json:
            print_json(_content(opened, season))
        else:
            _show(opened, season)


def _report(backup: Backup, action: str) -> None:
    print(f"{action}: {backup.seasons} seasons, {backup.entries} entries, {backup.jobs} jobs")
    for each in backup.missing:
        print(f"missing: {each}", file=sys.stderr)


def _show(opened: Board, season: str | None) -> None:
    console, info = stdout_console(), opened.season_info(season)
    standings, human_human = opened.standings(info.name), opened.human_human(info.name)
    show(board_table(info, standings, human_human, console.width), console=console)
    for each in opened.events(info.name):
        if each.submission is not None:
            what = f"{each.kind} of {each.submission[:16]} by {each.who}"
            print(f"{each.at:%Y-%m-%d} {what}: {each.why}")
    others = [each.name for each in opened.seasons() if each.name != info.name]
    if others:
        print(f"Other seasons: {', '.join(others)} (--season NAME)")
    if info.current:
        print(_waiting(opened))


def _waiting(opened: Board) -> str:
    open_jobs = [job for job in Queue(opened).jobs() if not job.ended]
    if not open_jobs:
        return "The queue is empty. To submit: colift submit DIR --board PATH"
    first = ", ".join(f"{job.name} ({job.state})" for job in open_jobs[:5])
    text = f"{len(open_jobs)} in the queue: {first}"
    missed = Queue(opened).unattended(open_jobs[0])
    return text if missed is None else f"{text}\n{missed}. To start one: colift worker --board PATH"


def _content(opened: Board, season: str | None) -> dict[str, Any]:
    info: SeasonInfo = opened.season_info(season)
    human_human = opened.human_human(info.name)
    opened.standings(info.name)  # With its own ranks.
    return {
        "season": {**vars(info), "began_at": info.began_at.isoformat()},
        "human_human": None
        if human_human is None
        else {
            "rmse_mm": plain_estimate(human_human.rmse_mm),
            **human_human.means,
        },
        "rows": standings_plain(opened, info.name),
    }
