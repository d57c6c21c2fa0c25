"""Decisions about rows that are on a board: each is an event, and no row disappears by one."""

from dataclasses import dataclass
from typing import Any

from colift.base.errors import InputError
from colift.leaderboard.core.board import Board
from colift.leaderboard.database.queries import record_errors, record_event
from colift.leaderboard.records.row import BoardRow
from colift.leaderboard.records.season import Event, Kind


@dataclass(frozen=True)
class Decisions:
    """Decisions about the rows of a board, each by somebody and for a reason."""

    board: Board

    def withdraw(self, season: str, digest: str, who: str, why: str) -> None:
        """Take a row out of the ranking at its submitter's request; it stays visible.

        Raises
        ------
        InputError
            If the submission has no row in that season.
        """
        self._record(season, digest, "withdrawal", who, why)

    def remove(self, season: str, digest: str, who: str, why: str) -> None:
        """Take a row out of the ranking at the maintainer's request; it stays visible."""
        self._record(season, digest, "removal", who, why)

    def reinstate(self, season: str, digest: str, who: str, why: str) -> None:
        """Take a withdrawn or removed row back into the ranking."""
        self._record(season, digest, "reinstatement", who, why)

    def rescore(
        self, season: str, row: BoardRow, hidden_rmse_mm: tuple[float, ...], who: str, why: str
    ) -> None:
        """Replace a row after a mistake in its evaluation; the entry stays.

        Parameters
        ----------
        season
            Its season.
        row
            The corrected row of the same submission.
        hidden_rmse_mm
            Corrected RMSE of each hidden episode.
        who, why
            The actor and the reason.

        Raises
        ------
        InputError
            If the submission has no row in that season.
        """
        content = {"row": row.plain()}
        self._record(season, row.submission, "rescore", who, why, content, hidden_rmse_mm)

    def _record(
        self,
        season: str,
        digest: str,
        kind: Kind,
        who: str,
        why: str,
        content: dict[str, Any] | None = None,
        hidden_rmse_mm: tuple[float, ...] = (),
    ) -> None:
        board = self.board
        entry = board.entry(season, digest)
        if entry is None or entry.row is None:
            raise InputError(f"season {season} of {board.folder} has no row of submission {digest}")
        event = Event(
            at=board.clock(),
            who=who,
            kind=kind,
            why=why,
            season=season,
            submission=digest,
            content=content,
        )
        with board.database.writing() as connection:
            record_event(connection, event)
            if hidden_rmse_mm:
                record_errors(connection, season, digest, hidden_rmse_mm)
