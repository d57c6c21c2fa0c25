"""Backups that are damaged, or none: refused in a sentence, and nothing is left."""

import gzip
import io
import os
import re
import tarfile
import zlib

import pytest
from colift.base.errors import InputError
from colift.benchmark.results.scores import ScoreTable
from colift.leaderboard.backup.restoring import restore
from colift.leaderboard.backup.writing import back_up
from colift.leaderboard.core.board import Board
from colift.leaderboard.core.decisions import Decisions
from colift.leaderboard.core.tokens import Tokens
from colift.leaderboard.pages.site import write_site
from colift.leaderboard.queue import Queue, WorkerQueue

from ..rows import add, digest
from ..signed import write_signed
from .damage import damaged, packed, table_changed, unpacked

pytestmark = pytest.mark.slow

MUTATIONS = int(os.environ.get("COLIFT_TEST_MUTATIONS", "20"))


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
    Decisions(board).withdraw("1", digest("one"), "Ada", "a mistake")
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
