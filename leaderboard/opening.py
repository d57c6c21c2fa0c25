"""Opens a board to be shown: a new one is not empty."""

from pathlib import Path

from .board import SUITE, Board
from .practice import SUITES
from .shipped import DATA, shipped_practice


def open_stocked(folder: Path, suite: str | None = None, data: Path = DATA) -> Board:
    """Return the board in a folder; a new one begins with the season that the project ships.

    The practice seasons of other suites stand beside it, to be looked at.

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
    if folder.is_dir() and any(folder.iterdir()):
        return Board.open(folder, suite)
    wanted = suite or SUITE
    with shipped_practice(wanted, data) as practice:
        board = Board.open(folder, suite, practice=practice)
    for other in SUITES:
        if practice is not None and other != wanted:
            with shipped_practice(other, data, current=False) as shown:
                if shown is not None:
                    board.adopt(shown)
    return board
