"""Backups: the same board again, from either database to either, also when the board is in use."""

import gzip
import io
import os
import re
import shutil
import signal
import sqlite3
import stat
import subprocess
import sys
import tarfile
import threading
import time
import zlib

import pytest
import sqlalchemy as sa
from colift.base.errors import InputError
from colift.benchmark.results.scores import ScoreTable
from colift.leaderboard.backup.restoring import restore
from colift.leaderboard.backup.writing import back_up
from colift.leaderboard.core.board import Board
from colift.leaderboard.core.tokens import Tokens
from colift.leaderboard.database.schema import metadata
from colift.leaderboard.pages.site import write_site
from colift.leaderboard.queue import NO_QUOTA, Queue, WorkerQueue
from colift.leaderboard.queue.attendance import sign_in
from colift.leaderboard.records.job import STATES

from .. import tiny
from ..conftest import new_schema
from ..rows import add, digest
from ..signed import write_signed
from .damage import damaged, packed, table_changed, unpacked

pytestmark = pytest.mark.slow

MUTATIONS = int(os.environ.get("COLIFT_TEST_MUTATIONS", "20"))


@pytest.fixture
def filled(board, write_submission):
    """Return a board with something in every table."""
    Tokens(board).add("ada")
    job = Queue(board).enqueue(board.keep(write_submission()), "ada")
    with board.database.writing() as connection:
        sign_in(connection, "host/machine/1/2", board.clock())
    board.store.add_to_log(job.id, "a line")
    board.store.add_to_private_log("1", job.id, "a secret line")
    for name in ("one", "two"):
        add(board, name, 10.0)
        bundle = board.store.bundle("1", digest(name))
        bundle.mkdir(parents=True)
        (bundle / "results.json").write_text(name)
    board.withdraw("1", digest("one"), "Ada", "a mistake")
    board.new_season("2")
    board.standings("1")
    return board


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


def archive(file, *names, first="backup.json"):
    with tarfile.open(file, "w:gz") as made:
        for name in (first, *names):
            entry = tarfile.TarInfo(name)
            content = b'{"format": 1, "board": 2}'
            entry.size = len(content)
            made.addfile(entry, io.BytesIO(content))


@pytest.mark.parametrize(
    ("names", "first", "words"),
    [
        ((), "other", "is not a backup of a board"),
        (("../out",), "backup.json", "is nothing that a backup of a board holds"),
        (("/out",), "backup.json", "is nothing that a backup of a board holds"),
        (("public/../../out",), "backup.json", "is nothing that a backup of a board holds"),
        (("board.json",), "backup.json", "is nothing that a backup of a board holds"),
        (("public/x",), "backup.json", r"it holds no board\.sqlite"),
    ],
)
def test_what_is_no_backup_is_refused_and_leaves_nothing(tmp_path, names, first, words):
    archive(tmp_path / "kept", *names, first=first)
    with pytest.raises(InputError, match=words):
        restore(tmp_path / "kept", tmp_path / "again")
    assert [path.name for path in tmp_path.iterdir()] == ["kept"]


def test_a_damaged_backup_is_refused_and_leaves_nothing(filled, tmp_path):
    back_up(filled, tmp_path / "kept")
    content = (tmp_path / "kept").read_bytes()
    damaged = [content[: len(content) // 2], content[:-1], b"no archive at all"]
    for place in range(12, len(content), len(content) // 40):
        damaged.append(content[:place] + bytes([content[place] ^ 0xFF]) + content[place + 1 :])
    for each in damaged:
        if unpacks_to(each, gzip.decompress(content)):
            continue  # Zeros copied from other zeros are no damage.
        (tmp_path / "damaged").write_bytes(each)
        with pytest.raises(InputError):
            restore(tmp_path / "damaged", tmp_path / "again")
        assert not (tmp_path / "again").exists()
        assert not list(tmp_path.glob(".*"))


@pytest.mark.parametrize("first", range(0, MUTATIONS, 5))
def test_a_damaged_backup_is_refused_in_a_sentence_or_its_board_can_be_used(
    board_file, tmp_path, monkeypatch, first
):
    """Seeded mutations of bytes, files and tables; COLIFT_TEST_MUTATIONS=200 makes more."""
    monkeypatch.setenv("COLUMNS", "200")
    for seed in range(first, first + 5):
        kept, place = tmp_path / f"kept{seed}", tmp_path / f"board{seed}"
        kept.write_bytes(damaged(board_file, seed, tmp_path))
        try:
            restore(kept, place)
        except InputError as error:
            told = str(error)
        else:
            told = ""
        if told:
            assert told.startswith(str(kept)) or "nothing that a backup" in told
            assert str(tmp_path / ".restore") not in told
            assert not place.exists()
            continue
        board = Board.open(place)
        try:
            board.standings()
            board.events()
            [job.plain() for job in Queue(board).jobs()]
            Tokens(board).all()
            back_up(board, tmp_path / f"again{seed}")
            if seed % 10 == 4:
                write_site(board, tmp_path / f"site{seed}")
        finally:
            board.close()


@pytest.mark.parametrize(
    ("change", "told"),
    [
        (
            """UPDATE entries SET row = '{"name": "one"}' WHERE number = 1""",
            "the entry of 'one' in",
        ),
        (
            "UPDATE entries SET row = '{' WHERE number = 1",
            "the table entries of the board cannot be",
        ),
        (
            "UPDATE entries SET row = replace(row, '10.0', '\"x\"') WHERE number = 1",
            "Expected `float`, got `str` - at `$.public.rmse_mm.mean`",
        ),
        ("UPDATE entries SET at = 'noon' WHERE number = 1", "cannot be read (ValueError:"),
        ("UPDATE hidden_errors SET rmse_mm = x'0011'", "a hidden episode of the board cannot be"),
        ("DELETE FROM hidden_errors", "has no errors of its hidden episodes"),
        (
            "UPDATE jobs SET done = 'many'",
            "'many' as done in the table jobs of the board cannot be read",
        ),
        ("DROP TABLE tokens", "lacks tokens.number"),
    ],
)
def test_what_is_damaged_in_a_table_is_named(board_file, tmp_path, change, told):
    members = unpacked(gzip.decompress(board_file))

    def changed(connection, chance):
        connection.execute(change)

    database = table_changed(members["board.sqlite"], None, tmp_path, changed)
    (tmp_path / "kept").write_bytes(packed({**members, "board.sqlite": database}))
    with pytest.raises(InputError, match=re.escape(told)) as caught:
        restore(tmp_path / "kept", tmp_path / "again")
    assert str(caught.value).startswith(f"{tmp_path}/kept cannot be restored: ")
    assert not (tmp_path / "again").exists()


@pytest.fixture(scope="module")
def board_file(tmp_path_factory):
    """Return the bytes of a backup of a board with something in every table."""
    place = tmp_path_factory.mktemp("kept")
    write_signed(place / "mine")
    board = Board.open(place / "board", "quick-v1", url="")
    for name in ("one", "two"):
        add(board, name, 10.0)
    Tokens(board).add("ada")
    job = Queue(board).enqueue(board.keep(place / "mine"), "ada")
    board.store.add_to_log(job.id, "a line")
    WorkerQueue(board).claim("host/machine/1/2")
    board.withdraw("1", digest("one"), "Ada", "a mistake")
    human = ScoreTable(strata=(("pause", "S1"),) * 12, values={"rmse_mm": (5.0,) * 12})
    board.store.secrets("1").keep_human_human(human)
    board.new_season("2")
    board.reveal("1", "Ada", "it is over")
    board.standings("1")
    back_up(board, place / "kept")
    board.close()
    return (place / "kept").read_bytes()


def unpacks_to(packed, content):
    try:
        return gzip.decompress(packed) == content
    except (EOFError, OSError, zlib.error):
        return False


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
