"""``colift submit`` as a user meets it: real processes, a real board."""

import contextlib
import os
import re
import signal
import subprocess
import sys
import time

import pytest
from colift.agents.submissions.new import write_template
from colift.leaderboard.views.job import STAGES

from ..agents.sandbox.keeping import COUNTING
from ..leaderboard import tiny
from ..leaderboard.signed import write_signed

pytestmark = pytest.mark.slow

TO_BOARD = ("--board", "board", "--suite", "quick-v1")
TO_TINY = ("--board", "tiny", "--suite", "tiny")

KEEPS_STATE = (
    COUNTING
    + """
class Policy:
    def reset(self, seed):
        pass

    def act(self, observation):
        more = 1e-9 * lifts if lifts > 3 else 0.0
        return [observation[0] - observation[3] + more]
"""
)


@pytest.fixture(scope="module")
def place(tmp_path_factory):
    return tmp_path_factory.mktemp("submit")


@pytest.fixture(scope="module")
def begin(place):
    """Return what starts the command in a folder of its own, with a cache of its own."""

    def start(*arguments):
        return subprocess.Popen(
            [sys.executable, tiny.__file__, *arguments],
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            text=True,
            cwd=place,
            env={**os.environ, "XDG_CACHE_HOME": str(place / "cache"), "COLUMNS": "100"},
            start_new_session=True,
        )

    return start


@pytest.fixture(scope="module")
def process(begin):
    """Return what runs the command to its end, in a process of its own."""

    def run(*arguments):
        process = begin(*arguments)
        out, err = process.communicate(timeout=300)
        return subprocess.CompletedProcess(arguments, process.returncode, out, err)

    return run


@pytest.fixture(scope="module")
def make(place):
    """Return what writes the template, with a part of the policy exchanged."""

    def write(name, old="", new=""):
        folder = place / name
        write_signed(folder)
        policy = folder / "policy.py"
        policy.write_text(
            policy.read_text().replace(old, new) if old else new or policy.read_text()
        )
        return folder

    return write


@pytest.fixture(scope="module")
def first(process, make):
    """Submit the template to a new board."""
    make("mine")
    return process("submit", "mine", *TO_BOARD)


def told(done):
    """Return what was printed, on one line."""
    return " ".join(done.stdout.split())


def test_a_submission_becomes_a_verified_row_whose_bundle_can_be_verified(colift, first, place):
    assert first.returncode == 0
    lines = set(first.stderr.splitlines()) - {*STAGES, "two people"}
    assert all(" does not work here: " in line for line in lines)
    for words in ("mine by Ada Lovelace", "public lifts", "hidden lifts", "0 of 12", "Rank 1 of 1"):
        assert words in told(first)
    assert re.search(r"Isolation (bubblewrap|landlock): verified", told(first))
    next_step = first.stdout.splitlines()[-1]
    assert next_step.startswith("Next: colift verify ")
    verified = colift(*next_step.removeprefix("Next: colift ").split(), cwd=place)
    assert verified.returncode == 0, verified.stdout + verified.stderr


def test_the_author_of_the_template_is_refused_before_all_else(colift, place):
    write_template(place / "unsigned")
    done = colift("submit", "unsigned", "--board", "none", cwd=place)
    assert done.returncode == 2
    assert "unsigned/policy.toml: authors still has 'Your Name'" in done.stderr
    assert "put your own name there" in done.stderr
    assert not (place / "none").exists()


def test_without_a_terminal_the_stages_are_lines_in_their_order(first):
    lines = first.stderr.splitlines()
    assert [line for line in lines if line in STAGES] == list(STAGES)


def test_the_row_has_the_number_that_check_prints(colift, first, place):
    (mean,) = re.findall(r"12 lifts: RMSE (\S+) mm", told(colift("check", "mine", cwd=place)))
    assert re.search(rf"RMSE mm {re.escape(mean)} \(", told(first))


def test_the_same_content_in_another_folder_is_on_the_board_already(colift, first, place):
    (place / "mine").rename(place / "renamed")
    second = colift("submit", "renamed", *TO_BOARD, cwd=place, COLUMNS="100")
    (place / "renamed").rename(place / "mine")
    assert second.returncode == 0
    assert "is on the board already" in second.stdout.splitlines()[0]
    assert second.stdout.splitlines()[1:] == first.stdout.splitlines()


def test_a_submission_that_was_killed_is_evaluated_when_it_comes_again(begin, process, make, place):
    make("worse", "gain = 1.8", "gain = 0.1")
    killed = begin("submit", "worse", *TO_TINY)
    while not list(place.glob("tiny/private/work/*/bundle")):
        assert killed.poll() is None
        time.sleep(0.01)
    killed.kill()
    killed.communicate()
    with contextlib.suppress(ProcessLookupError):
        os.killpg(killed.pid, signal.SIGKILL)
    done = process("submit", "worse", *TO_TINY)
    assert done.returncode == 0, done.stderr
    assert "already" not in done.stdout
    assert "Rank 1 of 1" in done.stdout
    assert list(place.glob("tiny/private/work/*/bundle")) == []


def test_a_policy_that_keeps_state_across_episodes_is_refused(process, make):
    make("keeping", new=KEEPS_STATE)
    for _ in range(2):
        done = process("submit", "keeping", *TO_TINY)
        assert done.returncode == 1
        assert "its check fails" in done.stderr
        assert "its actions must follow from its seed" in done.stderr
        assert "colift check keeping" in done.stderr
    assert "Rank" not in done.stdout


def test_what_fails_its_check_is_not_put_on_the_board(colift, first, make, place):
    before = sorted(place.glob("board/submissions/*"))
    make("broken", new="class Policy:\n    def reset(self, seed): pass\n")
    done = colift("submit", "broken", *TO_BOARD, cwd=place)
    assert done.returncode == 1
    assert "its check fails" in done.stderr
    assert "act" in done.stderr
    assert sorted(place.glob("board/submissions/*")) == before


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (("nowhere", "--board", "new"), "nowhere: no such folder"),
        (("empty", "--board", "new"), "colift new DIR"),
        (("mine", "--board", "mine"), "mine is not a board"),
        (("mine", "--board", "mine/policy.py"), "as a board"),
        (("mine", "--board", "board", "--suite", "paper-v1"), "a board of quick-v1"),
        (("mine", "--board", "new", "--jobs", "0"), "jobs must be at least 1"),
        (("mine",), "--board"),
        (("mine", "--board", "127.0.0.1:8017"), "did you mean http://127.0.0.1:8017?"),
        (("mine", "--board", "b.example.org:80/x"), "did you mean http://b.example.org:80/x?"),
        (("mine", "--board", "new", "--token", "x"), "new is a folder, which takes no --token"),
    ],
)
def test_what_is_wrong_is_said_in_a_line(colift, first, place, arguments, words):
    (place / "empty").mkdir(exist_ok=True)
    done = colift("submit", *arguments, cwd=place)
    assert done.returncode == 2
    assert words in done.stderr
    assert "Traceback" not in done.stderr
    assert not list(place.glob("new")) + list(place.glob("*:*"))


def test_a_token_in_the_environment_does_not_matter_to_a_folder(colift, first, place):
    done = colift("submit", "mine", *TO_BOARD, cwd=place, COLIFT_TOKEN="x")
    assert done.returncode == 0, done.stderr
