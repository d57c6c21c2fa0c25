"""``colift submit`` to a board on the web: a real service, a real worker."""

import contextlib
import os
import re
import signal
import subprocess
import sys
import urllib.request

import pytest
from colift.base.registry import SUITES, entries
from colift.leaderboard.core.board import Board
from colift.leaderboard.core.tokens import Tokens

from ..leaderboard import tiny
from ..leaderboard.signed import write_signed

pytestmark = pytest.mark.slow


@pytest.fixture(scope="module")
def place(tmp_path_factory):
    return tmp_path_factory.mktemp("there")


@pytest.fixture(scope="module")
def environment(place):
    return {**os.environ, "XDG_CACHE_HOME": str(place / "cache"), "COLUMNS": "100"}


@pytest.fixture(scope="module")
def board(place):
    with pytest.MonkeyPatch.context() as patched:
        patched.setitem(entries(SUITES), "tiny", tiny.ENTRY)
        board = Board.open(place / "board", "tiny")
        yield board
        board.close()


@pytest.fixture(scope="module")
def url(place, board, environment):
    """Serve the board, with a worker; return its address."""

    def start(*command):
        return subprocess.Popen(
            [sys.executable, tiny.__file__, *command, "--board", "board"],
            stdout=subprocess.PIPE,
            stderr=subprocess.DEVNULL,
            text=True,
            cwd=place,
            env=environment,
        )

    with start("serve", "--port", "0", "--workers", "0") as service, start("worker") as worker:
        yield service.stdout.readline().split()[2]
        for process in (service, worker):
            process.send_signal(signal.SIGTERM)


@pytest.fixture(scope="module")
def colift(place, environment):
    def run(*arguments, **more):
        return subprocess.run(
            [sys.executable, tiny.__file__, *arguments],
            capture_output=True,
            text=True,
            cwd=place,
            env={**environment, **more},
            timeout=300,
        )

    return run


def test_an_upload_becomes_a_row_that_is_printed(colift, url, board, place):
    write_signed(place / "mine")
    token = Tokens(board).add("ada")
    done = colift("submit", "mine", "--board", url, COLIFT_TOKEN=token)
    assert done.returncode == 0, done.stderr
    (standing,) = board.standings()
    assert (standing.row.name, standing.submitter) == ("mine", "ada")
    for words in (f"submitted; job {url}/jobs/", "mine by Ada Lovelace", "Rank 1 of 1"):
        assert words in done.stdout
    *_, bundle, page = done.stdout.splitlines()
    assert bundle.endswith(f"{standing.row.submission}/bundle.zip")
    (job,) = re.findall(rf"submitted; job ({url}/jobs/\w+)", done.stdout)
    for address in (page.removeprefix("Its page: "), job):
        with urllib.request.urlopen(address, timeout=30) as answer:
            assert answer.headers["Content-Type"].startswith("text/html")
            assert "mine" in answer.read().decode()
    again = colift("submit", "mine", "--board", f"{url}/", "--token", token)
    assert (again.returncode, "Rank 1 of 1" in again.stdout) == (0, True)
    assert len(board.standings()) == 1


def test_a_wrong_token_is_refused_before_all_else_in_the_boards_words(colift, url, place):
    write_signed(place / "other")
    (place / "other" / "policy.py").write_text("class Policy: ...")
    done = colift("submit", "other", "--board", url, "--token", "x")
    assert done.returncode == 2
    assert "this token is not valid" in done.stderr
    assert "Traceback" not in done.stderr


def test_what_is_no_board_is_told(colift, url, place):
    write_signed(place / "third")
    done = colift("submit", "third", "--board", f"{url}/elsewhere", "--token", "x")
    assert done.returncode == 2
    assert f"board {url}/elsewhere: " in done.stderr


def test_a_board_of_another_suite_than_the_wanted_one_is_refused_before_the_check(
    colift, url, board, place
):
    write_signed(place / "fourth")
    (place / "fourth" / "policy.py").write_text("class Policy: ...")
    token = Tokens(board).add("grace")
    done = colift("submit", "fourth", "--board", url, "--token", token, "--suite", "paper-v1")
    assert done.returncode == 2
    assert f"{url} is a board of tiny, not of paper-v1: give another one" in done.stderr


def test_a_board_without_a_worker_says_so_at_once_and_keeps_the_submission(
    colift, place, environment, tmp_path
):
    write_signed(tmp_path / "mine")
    command = [sys.executable, tiny.__file__]
    options = {"text": True, "cwd": tmp_path, "env": environment, "stderr": subprocess.PIPE}
    words = ["serve", "--board", "alone", "--port", "0", "--workers", "0"]
    with pytest.MonkeyPatch.context() as patched:
        patched.setitem(entries(SUITES), "tiny", tiny.ENTRY)
        with contextlib.closing(Board.open(tmp_path / "alone", "tiny")) as board:
            token = Tokens(board).add("ada")
    with subprocess.Popen([*command, *words], stdout=subprocess.PIPE, **options) as service:
        address = service.stdout.readline().split()[2]
        to = ["--board", address, "--token", token]
        with subprocess.Popen(
            [*command, "submit", "mine", *to], stdout=subprocess.DEVNULL, **options
        ) as waiting:
            lines = []
            for line in waiting.stderr:
                lines.append(line)
                if line.startswith("queued"):
                    break
            waiting.send_signal(signal.SIGINT)
            lines += waiting.stderr.readlines()
            assert waiting.wait(60) == 1
        service.send_signal(signal.SIGTERM)
    assert lines[0].startswith("Nobody evaluates at present: no worker of this board has been seen")
    assert "The submission is kept, and waits" in lines[0]
    assert "the board continues the evaluation" in lines[-1]
    listed = colift("queue", "list", "--board", str(tmp_path / "alone"))
    assert "queued" in listed.stdout
    assert re.search(r"\d{4}-\d\d-\d\d \d\d:\d\d UTC", listed.stdout)
    assert "Nobody evaluates at present: no worker" in listed.stdout
    assert f"colift worker --board {tmp_path / 'alone'}" in listed.stdout
