"""``colift season``: the seasons of a board."""

from typing import Annotated

import typer
from colift.benchmark.execution.progress import workers
from colift.benchmark.references.catalogue import suite_references
from colift.benchmark.results.baselines import reference_label
from colift.benchmark.suites.policies import made_for_suite
from colift.cli.board_options import BOARD, BoardFolder, ExistingBoard, Why, opened_board
from colift.cli.options import Jobs
from colift.leaderboard.core.board import LOCAL
from colift.leaderboard.evaluation.entrant import builtin_entrant
from colift.leaderboard.evaluation.evaluate import play_human_human, play_season_references
from colift.leaderboard.evaluation.progress import Callbacks
from colift.leaderboard.queue import Queue

app = typer.Typer(help="Begin and end the seasons of a board.", no_args_is_help=True)

NewSeason = Annotated[str, typer.Argument(metavar="NAME", help="Name of the season.")]


@app.command()
def begin(
    name: NewSeason,
    board: BoardFolder = BOARD,
    suite: Annotated[
        str | None, typer.Option(metavar="NAME", help="Suite; default: that of the last season.")
    ] = None,
    own: Annotated[bool, typer.Option(help="Queue colift's own policies, for comparison.")] = True,
) -> None:
    """Begin a season with a new secret; earlier rows stay in their own table.

    Example: colift season begin autumn --suite agree-v1 --board board
    """
    with opened_board(board, new=True) as opened:
        season = opened.new_season(name, suite)
        print(f"season {name} on {season.suite.name} takes submissions from now on")
        print(f"commitment to its secret: {season.commitment}")
        if own:
            names = made_for_suite(season.suite)
            jobs = [Queue(opened).enqueue_builtin(builtin_entrant(each)) for each in names]
            print(f"{len(jobs)} policies of the project are queued")
            print(f"Next: colift worker --board {board} --once")


@app.command()
def references(name: NewSeason, board: ExistingBoard = BOARD, jobs: Jobs = None) -> None:
    """Play the references on a season's hidden lifts: the board shows them beside the rows.

    Example: colift season references autumn --board board
    """
    with opened_board(board) as opened:
        season = opened.season_of(name)
        secrets = opened.store.secrets(name)
        beside = len(suite_references(season.hidden)) + (secrets.known_human_human() is None)
        total = season.hidden.size * beside
        with workers(f"references of season {name}", total, jobs) as (pool, progress):
            watch = Callbacks(progress=progress)
            secrets.human_human(lambda: play_human_human(season, executor=pool, watch=watch))
            found = play_season_references(season, executor=pool, progress=progress)
        secrets.keep_references(found)
        for each, scores in opened.references(name).items():
            print(f"{reference_label(each)}: {scores.rmse_mm.mean} mm on the hidden lifts")
        if not found:
            print(f"{season.suite.name} has no references")


@app.command()
def reveal(name: NewSeason, why: Why = "the season is over", board: ExistingBoard = BOARD) -> None:
    """Publish the secret of a finished season: anyone can then play its hidden lifts.

    Example: colift season reveal autumn --board board
    """
    with opened_board(board) as opened:
        opened.reveal(name, LOCAL, why)
        print(f"the secret of season {name}: {opened.season_info(name).revealed}")
