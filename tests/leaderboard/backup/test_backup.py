"""Backups: the same board again, from either database to either, also when the board is in use."""

import os
import re
import shutil
import signal
import sqlite3
import stat
import subprocess
import sys
import threading
import time

import pytest
import sqlalchemy as sa
from colift.base.errors import InputError
from colift.leaderboard.backup.restoring import restore
from colift.leaderboard.backup.writing import back_up
from colift.leaderboard.core.board import Board
from colift.leaderboard.core.tokens import Tokens
from colift.leaderboard.database.schema import metadata
from colift.leaderboard.queue import NO_QUOTA, Queue
from colift.leaderboard.records.job import STATES

from .. import tiny
from ..conftest import new_schema
from ..rows import add, digest
from ..signed import write_signed

pytestmark = pytest.mark.slow


def tables(board):
    with board.database.reading() as connection:
        return {
            table.name: connection.execute(sa.select(table)).all()
            for table in metadata.sorted_tables
        }


def files(folder):
    ours = ("private", "submissions", "logs", "public")
    return {
        path.relative_to(folder): path.read_bytes()
        for name in ours
        for path in (folder / name).rglob("*")
        if path.is_file() and path.name != "ranking"  # held while ranks are computed
    }


@pytest.mark.parametrize("target", ["sqlite", "postgresql"])
def test_a_restored_board_is_the_same(filled, tmp_path, target, request):
    url = None
    if target == "postgresql":
        url = new_schema(request.getfixturevalue("postgresql"))
    told = back_up(filled, tmp_path / "kept")
    assert (told.seasons, told.entries, told.jobs, told.missing) == (2, 2, 1, ())
    assert stat.S_IMODE((tmp_path / "kept").stat().st_mode) == 0o600
    above = tmp_path / "above"
    above.mkdir(mode=0o755)
    assert restore(tmp_path / "kept", above / "again", url) == told
    assert stat.S_IMODE(above.stat().st_mode) == 0o755
    again = Board.open(above / "again", url=url)
    try:
        before, after = tables(filled), tables(again)
        assert all(before.values())
        assert after.pop("rank_groups") == [], "they are computed again"
        del before["rank_groups"]
        assert after == before
        assert files(again.folder) == files(filled.folder)
        assert again.season.secret == filled.season.secret
        for place in ("private", "private/1", "private/1/logs", "submissions", "logs"):
            assert stat.S_IMODE((again.folder / place).stat().st_mode) == 0o700
        (secret,) = (again.folder / "private/1/logs").iterdir()
        assert stat.S_IMODE(secret.stat().st_mode) == 0o600
        add(again, "three", 11.0, season="2")  # Numbers go on where they were.
        with pytest.raises(sa.exc.DBAPIError, match="append-only"), again.database.writing() as c:
            c.execute(sa.text("DELETE FROM entries"))
    finally:
        again.close()


def test_what_is_lost_is_told_by_backup_and_restore(filled, tmp_path):
    shutil.rmtree(filled.store.bundle("1", digest("one")))
    (submission,) = (filled.folder / "submissions").iterdir()
    (submission / "policy.py").write_text("?")
    lost = (f"the bundle of {digest('one')} in season 1",)
    assert back_up(filled, tmp_path / "kept").missing == lost
    damaged = f"submission {submission.name} as it was submitted"
    assert restore(tmp_path / "kept", tmp_path / "again").missing == (*lost, damaged)


def test_what_is_there_is_not_replaced(filled, tmp_path):
    (tmp_path / "there").write_text("mine")
    with pytest.raises(InputError, match="is there already"):
        back_up(filled, tmp_path / "there")
    back_up(filled, tmp_path / "kept")
    with pytest.raises(InputError, match="is not empty; name a new folder"):
        restore(tmp_path / "kept", filled.folder)
    assert (tmp_path / "there").read_text() == "mine"


def test_a_database_that_is_not_empty_is_not_filled(board, tmp_path, postgresql):
    url = new_schema(postgresql)
    other = Board.open(tmp_path / "other", "quick-v1", url=url)
    before = tables(other)
    back_up(board, tmp_path / "kept")
    with pytest.raises(InputError, match="is not empty; name an empty one"):
        restore(tmp_path / "kept", tmp_path / "again", url)
    assert tables(other) == before
    other.close()
    assert not (tmp_path / "again").exists()


def test_other_files_in_the_folder_do_not_matter(tmp_path):
    """Such as what sqlite3's .backup has written there."""
    board = Board.open(tmp_path / "board", "quick-v1")
    board.close()
    with sqlite3.connect(board.folder / "board.sqlite") as source:
        source.execute(f"VACUUM INTO '{board.folder / 'copy.sqlite'}'")
    source.close()
    Board.open(board.folder).close()
    (tmp_path / "none").mkdir()
    (tmp_path / "none" / "copy.sqlite").touch()
    with pytest.raises(InputError, match="is not a board: it holds"):
        Board.open(tmp_path / "none")


def test_a_board_in_use_is_backed_up_whole(tmp_path, tiny_suite):
    """Uploads and a worker go on; every backup makes a board in which nothing is missing."""
    board = Board.open(tmp_path / "board", "tiny")
    queue, done = Queue(board, NO_QUOTA), threading.Event()
    program = [sys.executable, tiny.__file__]
    worker = subprocess.Popen(
        [*program, "worker", "--board", str(board.folder)],
        stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
    )  # fmt: skip

    def submit():
        number = 0
        while not done.is_set():
            folder = tmp_path / f"p{number}"
            write_signed(folder)
            told = (folder / "policy.toml").read_text()
            told = re.sub('name = ".*"', f'name = "p{number}"', told)
            (folder / "policy.toml").write_text(told)
            with board.store.staging() as place:
                shutil.copytree(folder, place / "files")
                incoming = board.store.incoming(place / "files")
                queue.enqueue(incoming.submission, "ada", incoming.place)
            number += 1
            time.sleep(0.3)

    submitter = threading.Thread(target=submit)
    submitter.start()
    try:
        made, end = [], time.monotonic() + 180
        while len(made) < 3 or (made[-1].entries < 1 and time.monotonic() < end):
            made.append(back_up(board, tmp_path / f"kept{len(made)}"))
            time.sleep(1)
    finally:
        done.set()
        submitter.join()
        worker.send_signal(signal.SIGTERM)
        worker.wait(60)
        board.close()
    assert made[-1].entries >= 1
    assert made[-1].jobs > made[0].jobs
    for number, told in enumerate(made):
        assert told.missing == ()
        assert restore(tmp_path / f"kept{number}", tmp_path / f"again{number}") == told
    last = tmp_path / f"again{len(made) - 1}"
    again = Board.open(last)
    try:
        states = [job.state for job in Queue(again).jobs(limit=10_000)]
        assert set(states) <= set(STATES)
        assert states.count("done") == len(again.standings()) == made[-1].entries
        job = Queue(again).jobs(state="queued", limit=10_000)[-1]
    finally:
        again.close()
    # Life goes on there: what was begun or waited is evaluated.
    once = subprocess.Popen([*program, "worker", "--board", str(last)], stdout=subprocess.DEVNULL)
    try:
        again = Board.open(last)
        end = time.monotonic() + 120
        while Queue(again).job(job.id).state != "done":
            assert time.monotonic() < end
            time.sleep(0.2)
        again.close()
    finally:
        once.send_signal(signal.SIGTERM)
        once.wait(60)


@pytest.mark.skipif(not shutil.which("bwrap"), reason="needs bubblewrap: apt install bubblewrap")
def test_a_board_that_cannot_be_written_can_be_read_and_backed_up(tmp_path):
    board = Board.open(tmp_path / "board", "quick-v1")
    add(board, "mine", 10.0)
    Tokens(board).add("ada")
    before = {path: path.read_bytes() for path in board.folder.rglob("*") if path.is_file()}

    def colift(*arguments):
        program = [sys.executable, "-m", "colift.cli", *arguments, "--board", str(board.folder)]
        walls = ["bwrap", "--dev-bind", "/", "/", "--ro-bind", board.folder, board.folder]
        return subprocess.run(
            [*walls, *program], capture_output=True, text=True, timeout=100, cwd=tmp_path,
            env={**os.environ, "COLUMNS": "120"},
        )  # fmt: skip

    try:
        shown = colift("board")
        assert (shown.returncode, "mine" in shown.stdout) == (0, True), shown.stderr
        assert "ada" in colift("token", "list").stdout
        assert colift("queue", "list").stdout == "No job.\n"
        told = colift("board", "--backup", "kept")
        assert "1 seasons, 1 entries, 0 jobs" in told.stdout
        assert "missing: the bundle of" in told.stderr
        refused = colift("token", "add", "eve")
        assert refused.returncode == 2
        assert "Traceback" not in refused.stderr
        assert before == {path: path.read_bytes() for path in before}
    finally:
        board.close()
    restored = colift("board", "--restore", "kept")
    assert restored.returncode == 2
    assert "is not empty" in restored.stderr
