"""Stored databases of a small board, one for each revision and each kind of database.

``python -m tests.leaderboard.revisions.make`` writes those of the present revision, once, when it
is new; those of older revisions stay as the colift of their time wrote them.
"""

import sqlite3
import subprocess
import tempfile
from datetime import UTC, datetime
from pathlib import Path

from colift.leaderboard.core.board import Board
from colift.leaderboard.core.decisions import Decisions
from colift.leaderboard.core.tokens import Tokens
from colift.leaderboard.database.connection import FILE
from colift.leaderboard.database.migration import HEAD
from colift.leaderboard.queue import Queue, WorkerQueue

from ..postgresql import binaries, server
from ..rows import add, digest
from ..signed import write_signed

HERE = Path(__file__).parent
BEGAN = datetime(2026, 11, 20, 8, 30, tzinfo=UTC)


def stored(revision: str, kind: str) -> str:
    """Return a stored database as SQL; the kind is sqlite or postgresql."""
    return (HERE / f"{revision}_{kind}.sql").read_text()


def fill(folder: Path, url: str | None) -> None:
    """Make a board with a row, a removed row, a token, a job at work and one that waits."""
    board = Board.open(folder / "board", "quick-v1", url=url, clock=lambda: BEGAN)
    for name, mean in (("mine", 10.0), ("yours", 12.5)):
        add(board, name, mean)
    Decisions(board).remove("1", digest("yours"), "local", "a mistake")
    Tokens(board).add("ada")
    for name in ("first", "second"):
        write_signed(folder / name)
        Queue(board).enqueue(board.keep(folder / name), "ada")
    work = WorkerQueue(board)
    job = work.claim("host/machine/12/34")
    assert job is not None
    work.report(job, "public run", 3)
    board.standings()
    board.close()


def plain(dump: str) -> str:
    """Return what pg_dump writes without comments and settings, for a schema of any name."""
    left_out = ("--", "\\", "SET ", "SELECT pg_catalog.set_config")
    lines = (line for line in dump.splitlines() if line and not line.startswith(left_out))
    return "\n".join(lines).replace("public.", "") + "\n"


def main() -> None:
    """Write the databases of the present revision."""
    with tempfile.TemporaryDirectory() as folder:
        fill(Path(folder), None)
        with sqlite3.connect(Path(folder, "board", FILE)) as connection:
            text = "\n".join(connection.iterdump()) + "\n"
        (HERE / f"{HEAD}_sqlite.sql").write_text(text)
    with server() as url, tempfile.TemporaryDirectory() as folder:
        fill(Path(folder), url)
        command = [binaries() / "pg_dump", "-U", "colift", "-h", url.partition("host=")[2]]
        command += ["--inserts", "--no-owner", "postgres"]
        dumped = subprocess.run(command, check=True, capture_output=True, text=True)
        (HERE / f"{HEAD}_postgresql.sql").write_text(plain(dumped.stdout))


if __name__ == "__main__":
    main()
