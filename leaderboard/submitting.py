"""From a folder to an entry of a board, at once."""

from concurrent.futures import Executor

from ..agents.submissions.submission import Submission
from .board import Board
from .entry import Entry
from .evaluation import Entrant, Watch, amount, evaluate, play_team
from .season import Season


def enter(
    board: Board,
    submission: Submission,
    *,
    executor: Executor | None = None,
    watch: Watch | None = None,
) -> Entry:
    """Return a submission's entry; it is evaluated if it has none in this season.

    Parameters
    ----------
    board
        The board.
    submission
        What :meth:`.Board.keep` has returned.
    executor, watch
        As for :func:`.evaluate`.

    Raises
    ------
    InputError
        If another process evaluates it just now, or the policy cannot be loaded.
    EvaluatorFault
        If the machine failed; nothing is recorded, and it may be submitted again.
    KeyboardInterrupt
        After Ctrl-C; likewise.
    """
    season, digest = board.season, submission.contents.digest
    with board.evaluating(digest) as files:
        entry = board.entry(season.name, digest)
        if entry is not None:
            return entry
        vault = board.vault(season.name)
        team = vault.team(lambda: play_team(season, executor=executor, watch=watch))
        bundle = files / board.bundle(season.name, digest).name
        evaluation = evaluate(
            Entrant.of(submission), season, team, bundle, executor=executor, watch=watch
        )
        entry = Entry(submission=digest, row=evaluation.row, refusal=evaluation.refusal)
        if entry.row is not None:
            vault.keep_errors(digest, evaluation.hidden_rmse_mm)
        board.record(season.name, entry, files)
        return entry


def work(board: Board, season: Season) -> int:
    """Return how many episodes :func:`enter` counts for a submission that has no entry."""
    team = 0 if board.vault(season.name).has_team else season.suite.size
    return amount(season) + team
