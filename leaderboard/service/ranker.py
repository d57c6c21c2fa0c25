"""The thread that computes ranks, so that no reader has to."""

import logging
import threading
from typing import Final

import sqlalchemy as sa
from colift.leaderboard.core.board import Board

log: Final = logging.getLogger("colift.service")

LOOK_S: Final = 1.0
"""Time between two looks at the tables [s]."""


class Ranker:
    """A thread that brings the tables of a board up to date, and computes missing ranks.

    A worker computes the ranks after its row; this is for changes by others, and for workers that
    were killed. Only one process of a board computes ranks at a time, see :meth:`.Store.ranking`.

    Parameters
    ----------
    board
        The board.
    """

    def __init__(self, board: Board) -> None:
        self._board = board
        self._stop = threading.Event()
        self._thread = threading.Thread(target=self._run, name="ranker", daemon=True)

    def start(self) -> None:
        """Start the thread."""
        self._thread.start()

    def stop(self) -> None:
        """End the thread, after the ranks that it computes."""
        self._stop.set()
        self._thread.join()

    def _run(self) -> None:
        while not self._stop.is_set():
            try:
                current = self._board.season_info().name
                for season in {current, *self._board.tables.seasons}:
                    self._board.tables.ranked(season)
            except (sa.exc.OperationalError, sa.exc.InterfaceError, sa.exc.TimeoutError):
                pass  # The database is away, or busy: the next look does it.
            except Exception:
                log.exception("the ranks could not be computed")
                self._stop.wait(LONG_S)
            self._stop.wait(LOOK_S)


LONG_S: Final = 60.0
"""Pause after a fault [s], which would be one again at once."""
