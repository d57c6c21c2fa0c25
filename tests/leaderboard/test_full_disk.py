"""A board whose disk is full: it can be read, and what cannot be written is told as what it is."""

import os
import shutil
import subprocess
import sys

import pytest
from colift.leaderboard.core.board import Board
from colift.leaderboard.core.tokens import Tokens

from .rows import add
from .signed import write_signed

pytestmark = pytest.mark.slow

IN_NAMESPACE = ["unshare", "--user", "--map-root-user", "--mount"]

FILL = """
mount -t tmpfs -o size=6m none "$1" && cp -a "$2/." "$1" && rm -f "$1"/board/board.sqlite-*
head -c 64m /dev/zero > "$1/much" 2> /dev/null
exec "$3" -m colift.cli "${@:4}"
"""
"""Mounts a small disk, puts a board on it, fills it, and runs a command."""


@pytest.fixture(scope="module")
def place(tmp_path_factory):
    return tmp_path_factory.mktemp("full")


@pytest.fixture(scope="module")
def colift(place):
    """Return what runs a command beside a board on a full disk."""
    probe = [*IN_NAMESPACE, "mount", "-t", "tmpfs", "none", "/mnt"]
    if (
        not shutil.which("unshare")
        or subprocess.run(probe, capture_output=True, check=False).returncode
    ):
        pytest.skip("needs user namespaces in which a disk can be mounted")
    (place / "full").mkdir()
    board = Board.open(place / "kept/board", "quick-v1", url="")
    add(board, "mine", 10.0)
    Tokens(board).add("ada")
    board.standings()
    board.close()
    write_signed(place / "another")

    def run(*arguments, **more):
        script = ["bash", "-c", FILL, "fill", place / "full", place / "kept", sys.executable]
        environment = {**os.environ, "XDG_CACHE_HOME": str(place / "cache"), "COLUMNS": "120"}
        return subprocess.run(
            [*IN_NAMESPACE, *map(str, script), *arguments],
            capture_output=True,
            text=True,
            check=False,
            cwd=place,
            env=environment | more,
            timeout=300,
        )

    return run


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (("board",), "mine"),
        (("queue", "list"), "No job."),
        (("token", "list"), "ada"),
        (("board", "--json"), '"name": "mine"'),
    ],
)
def test_a_board_on_a_full_disk_can_be_read(colift, arguments, words):
    done = colift(*arguments, "--board", "full/board")
    assert (done.returncode, done.stderr) == (0, "")
    assert words in done.stdout


def test_a_board_on_a_full_disk_can_be_backed_up_to_another(colift, tmp_path):
    done = colift("board", "--board", "full/board", "--backup", str(tmp_path / "kept"))
    assert done.returncode == 0, done.stderr
    assert (tmp_path / "kept").stat().st_size > 1000


@pytest.mark.parametrize(
    ("arguments", "more", "told"),
    [
        (("token", "add", "eve", "--board", "full/board"), {}, "the disk of full/board is full"),
        (("submit", "another", "--board", "full/board"), {}, "the disk of full/board is full"),
        (("submit", "another", "--board", "full/new"), {}, "the disk of full/new is full"),
        (("worker", "--once", "--board", "full/board"), {}, "the disk of full/board is full"),
        (
            ("submit", "another", "--board", "full/board"),
            {"XDG_CACHE_HOME": "full/cache"},
            "full/cache/colift/submissions is full: No space left on device",
        ),
        (
            ("board", "--board", "kept/board", "--backup", "full/backup"),
            {},
            "the disk of full is full",
        ),
    ],
)
def test_what_cannot_be_written_is_told_as_a_full_disk(colift, place, arguments, more, told):
    done = colift(*arguments, **more)
    assert done.returncode in (1, 2)
    assert told in done.stderr.replace(f"{place}/", "")
    assert "Traceback" not in done.stderr
    assert done.stderr.splitlines()[-1].startswith("error: ")
