"""Opens a board to be shown: a new one is not empty."""

from pathlib import Path

from .board import Board
from .shipped import DATA, shipped_practice


def open_stocked(folder: Path, suite: str | None = None, data: Path = DATA) -> Board:
    """Return the board in a folder; a new one begins with the season that the project ships.

    Parameters
    ----------
    folder, suite
        As for :meth:`.Board.open`.
    data
        Where what is shipped lies.

    Raises
    ------
    InputError
        As :meth:`.Board.open`.
    """
    new = not (folder.is_dir() and any(folder.iterdir()))
    board = Board.open(folder, suite)
    if new:
        with shipped_practice(board.season.suite.name, data) as practice:
            if practice is not None:
                board.adopt(practice)
    return board
