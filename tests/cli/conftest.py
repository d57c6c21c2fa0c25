"""The command line in this process, where a test is about what it does and says."""

import sys
from typing import NamedTuple

import pytest
from colift.cli.main import main
from colift.leaderboard.core.board import Board


class Done(NamedTuple):
    """What a command left."""

    returncode: int
    stdout: str
    stderr: str


@pytest.fixture
def board(tmp_path):
    """A board of quick-v1 in the folder of the test."""
    board = Board.open(tmp_path / "board", "quick-v1")
    yield board
    board.close()


@pytest.fixture
def colift(monkeypatch, capfd, tmp_path):
    """Return what runs the command, in a folder of the test's own."""

    def run(*arguments, cwd=tmp_path, **environment):
        with monkeypatch.context() as patched:
            patched.chdir(cwd)
            patched.setattr(sys, "argv", ["colift", *map(str, arguments)])
            for name, value in environment.items():
                patched.setenv(name, value)
            with pytest.raises(SystemExit) as end:
                main()
        return Done(end.value.code or 0, *capfd.readouterr())

    return run
