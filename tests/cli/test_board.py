"""``colift board``, ``token`` and ``worker`` as a user meets them."""

import csv
import html
import io
import json
import os
import xml.etree.ElementTree as ET

import pytest
from colift.base.registry import SUITES, entries
from colift.benchmark.results.scores import ScoreTable
from colift.cli.tables.board import board_table
from colift.leaderboard.core.board import Board
from colift.leaderboard.core.decisions import Decisions
from colift.leaderboard.core.tokens import Tokens
from colift.leaderboard.queue import Queue
from rich.console import Console

from ..leaderboard.rows import add, digest, unverified
from ..leaderboard.signed import write_signed
from ..leaderboard.tiny import ENTRY

LONG = "a-policy-with-a-rather-long-name-indeed-so-long-that-it-is-cut"


@pytest.fixture
def filled(board):
    """Return a board of three rows, one taken out, and the human-human baseline between them."""
    for name, mean in ((LONG, 9.8), ("blend", 16.27), ("cheat", 1.2)):
        add(board, name, mean)
    Decisions(board).withdraw("1", digest("cheat"), "Ada", "it read the [bold]clock[/bold]")
    strata = tuple(("pause", f"S{i}") for i in range(1, 5))
    human_human = ScoreTable(
        strata=strata,
        values={"rmse_mm": (9.9, 10.5, 11.0, 10.8)},
        means={"sparc": -2.79, "human_force_n": 0.37},
    )
    board.store.secrets("1").keep_human_human(human_human)
    return board


def shown(board, width):
    console = Console(width=width, record=True, file=open(os.devnull, "w"))  # noqa: PTH123, SIM115
    with console.file:
        table = board_table(board.season_info(), board.standings(), board.human_human(), width)
        console.print(table)
    return console.export_text().splitlines()


@pytest.mark.parametrize("width", [80, 120])
def test_the_table_fits_and_cuts_only_names(filled, width):
    lines = shown(filled, width)
    assert max(map(len, lines)) <= width
    assert [line for line in lines if "…" in line] == [line for line in lines if LONG[:8] in line]
    rows = [line.split() for line in lines if " to " in line]
    assert [row[0] for row in rows] == ["1", "two", "2", "out"]
    assert rows[0][2:6] == ["9.80", "8.80", "to", "10.80"]
    assert rows[1][2:6] == ["10.55", "9.81", "to", "11.34"]
    assert ("0.200" in " ".join(rows[2])) == (width == 120)
    assert (rows[2][-1] == "yes") == (width == 120)
    assert all("0.30" in row for row in rows if row[0] != "two")
    text = " ".join(" ".join(lines).split())
    assert "SPARC" in text
    assert "force N" in text
    assert "wider terminal" not in text


def test_a_terminal_without_room_leaves_out_the_last_metrics_and_says_so(filled):
    lines = shown(filled, 70)
    assert max(map(len, lines)) <= 70
    assert [line for line in lines if "…" in line] == [line for line in lines if LONG[:8] in line]
    text = " ".join(" ".join(lines).split())
    assert "SPARC verified" not in text
    assert "force N" not in text
    assert "SPARC: public lifts. Only in a wider terminal: force." in text


def test_a_row_that_is_not_verified_is_marked_at_any_width(board):
    add(board, "free", 1.0, change=unverified)
    for width in (60, 80, 120):
        assert any(line.split()[:2] == ["unverified", "free"] for line in shown(board, width))


def test_the_command_shows_what_happened_and_what_waits(filled, colift, tmp_path):
    write_signed(tmp_path / "mine")
    Queue(filled).enqueue(filled.keep(tmp_path / "mine"), "Ada")
    done = colift("board", "--board", "board")
    assert (done.returncode, done.stderr) == (0, "")
    assert "withdrawal of 6368656174636865 by Ada: it read the [bold]clock[/bold]" in done.stdout
    assert "1 in the queue: mine (queued)" in done.stdout


def test_json_is_alone_on_stdout(filled, colift):
    told = json.loads(colift("board", "--board", "board", "--json").stdout)
    assert [(each["rank"], each["row"]["name"]) for each in told["rows"]] == [
        (1, LONG),
        (2, "blend"),
        (0, "cheat"),
    ]
    assert told["human_human"]["rmse_mm"]["mean"] == 10.55
    assert (told["season"]["name"], told["season"]["revealed"]) == ("1", None)


def test_a_token_is_made_listed_and_revoked(board, colift):
    made = colift("token", "add", "ada", "--board", "board")
    assert Tokens(board).submitter(made.stdout.strip()) == "ada"
    assert "ada" in colift("token", "list", "--board", "board").stdout
    assert "is revoked" in colift("token", "revoke", "ada", "--board", "board").stdout
    assert Tokens(board).submitter(made.stdout.strip()) is None


def test_the_tokens_of_a_course_are_csv(board, colift):
    made = colift("token", "add", "ada", "emmy", "grace", "--board", "board")
    rows = list(csv.DictReader(io.StringIO(made.stdout)))
    assert [each["name"] for each in rows] == ["ada", "emmy", "grace"]
    assert [Tokens(board).submitter(each["token"]) for each in rows] == ["ada", "emmy", "grace"]
    refused = colift("token", "add", "max", "Jörg Müller", "--board", "board")
    assert (refused.returncode, refused.stdout) == (2, "")
    assert refused.stderr.startswith("error: 'Jörg Müller' must be letters A to Z")
    assert len(Tokens(board).all()) == 3


def test_a_site_has_the_title_of_its_course(filled, colift, tmp_path):
    title = "HRI 2027 <Zürich>"
    done = colift("board", "--board", "board", "--site", "site", "--title", title)
    assert done.returncode == 0, done.stderr
    page = html.unescape((tmp_path / "site/index.html").read_text())
    assert f"<title>Season 1 · {title}</title>" in page
    feed = ET.parse(tmp_path / "site/data/1.atom").find("{http://www.w3.org/2005/Atom}title")
    assert feed.text == f"{title}, season 1"
    for bad in ("", "x" * 61, "two\nlines", " around "):
        refused = colift("board", "--board", "board", "--site", "site", "--title", bad)
        assert refused.returncode == 2
        assert "error: --title must be 1 to 60 letters on one line" in refused.stderr
    lonely = colift("board", "--board", "board", "--title", title)
    assert "--title belongs to --site" in lonely.stderr


def test_a_board_that_begins_with_a_token_has_the_practice_rows(colift, tmp_path):
    made = colift("token", "add", "ada", "--board", "new")
    board = Board.open(tmp_path / "new")
    assert Tokens(board).submitter(made.stdout.strip()) == "ada"
    assert "blend" in {entry.row.name for entry in board.standings()}
    board.close()


@pytest.mark.slow
def test_a_worker_does_what_waits_and_ends(colift, tmp_path, monkeypatch):
    monkeypatch.setitem(entries(SUITES), "tiny", ENTRY)
    board = Board.open(tmp_path / "board", "tiny")
    write_signed(tmp_path / "mine")
    Queue(board).enqueue(board.keep(tmp_path / "mine"), "Ada")
    done = colift("worker", "--board", "board", "--once")
    assert done.returncode == 0, done.stderr
    assert done.stdout.split()[0] == "mine"
    assert done.stdout.split()[-1] == "done"
    assert board.standings()[0].row.verified
    board.close()


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (("board", "--board", "board", "--season", "9"), "no season '9'; it has 1"),
        (("token", "revoke", "ada", "--board", "board"), "'ada' has no token"),
        (("worker", "--board", "board", "--jobs", "0"), "jobs must be at least 1"),
        (
            ("worker", "--board", "board", "--jobs", "1", "--dask", "tcp://x:1"),
            "exclude each other",
        ),
        (("submit", "mine", "--board", "http://127.0.0.1:9"), "needs a token"),
        (("submit", "mine", "--board", "http://127.0.0.1:9", "--token", "x"), "does not answer"),
    ],
)
def test_what_is_wrong_is_said_in_a_line(board, colift, tmp_path, arguments, words):
    write_signed(tmp_path / "mine")
    done = colift(*arguments)
    assert done.returncode == 2
    assert words in done.stderr
    assert "Traceback" not in done.stderr


@pytest.mark.parametrize(
    "command",
    [
        ("board",),
        ("board", "--restore", "backup"),
        ("queue", "list"),
        ("row", "remove", "mine", "--why", "x"),
        ("season", "begin", "2027"),
        ("serve",),
        ("token", "add", "ada"),
        ("worker", "--once"),
    ],
)
@pytest.mark.parametrize(
    ("given", "address"),
    [
        ("http://127.0.0.1:8017", "http://127.0.0.1:8017"),
        ("HTTPS://board.example.org/b/", "https://board.example.org/b"),
        ("localhost:8017", "http://localhost:8017"),
    ],
)
def test_an_address_is_not_taken_for_a_folder(colift, tmp_path, command, given, address):
    done = colift(*command, "--board", given)
    assert (done.returncode, done.stdout) == (2, "")
    assert f"got the address {address}: open it in a browser" in done.stderr
    assert f"see {address}/api;" in done.stderr
    assert done.stderr.count("\n") == 1
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize(
    "command",
    [
        ("board",),
        ("board", "--backup", "file"),
        ("queue", "list"),
        ("queue", "log", "1"),
        ("queue", "cancel", "1", "--why", "x"),
        ("row", "remove", "mine", "--why", "x"),
        ("season", "reveal", "2027"),
        ("token", "list"),
        ("token", "revoke", "ada"),
    ],
)
def test_what_only_reads_or_changes_a_board_makes_none(colift, tmp_path, command):
    done = colift(*command, "--board", "brd")
    assert (done.returncode, done.stdout) == (2, "")
    assert "there is no board in brd: check --board; 'colift submit'" in done.stderr
    assert list(tmp_path.iterdir()) == []


def test_a_first_look_without_a_board_shows_the_practice_season(colift):
    done = colift("board")
    assert done.returncode == 0
    assert "Season practice-robust-v1" in done.stdout


@pytest.mark.parametrize("command", ["board", "row"])
def test_a_damaged_row_is_named_in_a_sentence_by_the_first_command_that_reads_it(
    colift, filled, tmp_path, command
):
    with filled.database.writing() as connection:
        connection.exec_driver_sql("DROP TRIGGER entries_no_UPDATE")
        connection.exec_driver_sql("UPDATE entries SET row = '{}' WHERE name = 'blend'")
    more = {"board": (), "row": ("withdraw", "cheat", "--why", "x", "--by", "Ada")}[command]
    done = colift(command, *more, "--board", "board")
    assert done.returncode == 1
    assert done.stderr.startswith(
        "error: the entry of 'blend' in season '1' of the board cannot be"
    )
    assert done.stderr.endswith("its database is damaged; restore an earlier backup\n")
    (filled.folder / "private/1/human_human.json").write_text("{")
    with filled.database.writing() as connection:
        connection.exec_driver_sql("DELETE FROM jobs")
        connection.exec_driver_sql("DROP TRIGGER entries_no_DELETE")
        connection.exec_driver_sql("DELETE FROM entries WHERE name = 'blend'")
    done = colift("board", "--board", "board")
    assert (done.returncode, "human_human.json is damaged (" in done.stderr) == (1, True)
