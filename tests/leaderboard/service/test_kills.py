"""Service and worker are killed in the middle of things: nothing that was accepted is lost.

``COLIFT_TEST_KILLS=10`` kills ten times, with three submissions.
"""

import os
import random
import shutil
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest
from colift.leaderboard.core.board import Board
from colift.leaderboard.queue import Queue
from colift.leaderboard.records.job import HELD
from colift.leaderboard.views.job import STAGES

from ... import web
from ..tiny import ENTRY

pytestmark = pytest.mark.slow

ROOT = Path(__file__).parents[3]
KILLS = int(os.environ.get("COLIFT_TEST_KILLS", "2"))
SUBMISSIONS = 1 + KILLS // 5

COLIFT = (sys.executable, "-m", "colift.cli")
TIMES = ("step_ms_p50", "step_ms_p99", "real_time")
"""What no two runs have in common."""


@pytest.fixture(scope="module")
def folder(tmp_path_factory, tiny_suite):
    """A board of two lifts, whose suite the processes of the service find as an installed one."""
    place = tmp_path_factory.mktemp("kills")
    told = place / "installed" / "tiny-1.dist-info"
    told.mkdir(parents=True)
    (told / "METADATA").write_text("Metadata-Version: 2.1\nName: tiny\nVersion: 1\n")
    (told / "entry_points.txt").write_text(f"[{ENTRY.group}]\n{ENTRY.name} = {ENTRY.value}\n")
    with pytest.MonkeyPatch.context() as patched:
        for path in (ROOT, told.parent):
            patched.setenv("PYTHONPATH", str(path), prepend=os.pathsep)
        Board.open(place / "board", "tiny").close()
        yield place / "board"


def children(process):
    def parent(path):
        try:
            return int((path / "stat").read_text().rpartition(")")[2].split()[1])
        except (FileNotFoundError, ProcessLookupError):
            return None

    return [int(path.name) for path in Path("/proc").glob("[0-9]*") if parent(path) == process]


def idle(queue):
    return all(job.ended for job in queue.jobs())


def at_work(queue, stages):
    """Return whether an evaluation is in one of some stages."""
    return any(job.state in HELD and job.stage in stages for job in queue.jobs())


def until(condition):
    """Wait for something that must come."""
    end = time.monotonic() + 180 * SUBMISSIONS
    while not condition():
        assert time.monotonic() < end, "it has not come"
        time.sleep(0.05)


def plain(row):
    """Return what a row says, without times."""
    parts = {
        part: {key: value for key, value in row[part].items() if key not in TIMES}
        for part in ("public", "hidden")
    }
    return row | parts


def start(folder):
    command = [*COLIFT, "serve", "--board", str(folder), "--port", "0", "--workers", "1"]
    process = subprocess.Popen(command, stdout=subprocess.PIPE, text=True)
    return process, process.stdout.readline().split(": ", 1)[1].split()[0]


@pytest.fixture
def serve(folder):
    """Return what starts the service, with a worker; at the end it is ended."""
    last = []

    def run():
        if last:
            last[-1].wait(60)
            last[-1].stdout.close()
        process, url = start(folder)
        last.append(process)
        return process, url

    yield run
    last[-1].terminate()
    last[-1].wait(60)
    last[-1].stdout.close()


@pytest.fixture
def expected(folder, tmp_path, opening, zipped):
    """Return what makes the rows of jobs on a copy of the board, where nobody is killed."""
    copy = tmp_path / "copy"
    shutil.copytree(folder, copy)

    def rows(digests):
        for digest in digests:
            shutil.copytree(folder / "submissions" / digest, copy / "submissions" / digest)
        with opening(copy) as board:
            for digest in digests:
                Queue(board).enqueue(board.store.submission(digest), "ada")
        subprocess.run([*COLIFT, "worker", "--board", str(copy), "--once"], check=True, timeout=300)
        with opening(copy) as board:
            return {each.row.submission: plain(each.row.plain()) for each in board.standings()}

    return rows


def test_every_accepted_submission_gets_the_row_that_it_gets_undisturbed(
    folder, serve, expected, ada, zipped, opening
):
    chance = random.Random(20261121)
    process, url = serve()
    digests = []
    for number in range(SUBMISSIONS):
        answer = web.post(
            f"{url}/api/v1/submissions", headers=ada, content=zipped(f"p{number}"), timeout=60
        )
        assert answer.status_code == 202
        digests.append(answer.json()["submission"])
    with opening(folder) as board:
        queue = Queue(board)
        for number in range(KILLS):
            # The first moment is right after the answer: an upload that was accepted is kept.
            if number:
                stages = STAGES[chance.randrange(len(STAGES)) :]
                until(lambda stages=stages: at_work(queue, stages) or idle(queue))
            victims = children(process.pid) if number % 3 != 1 else []
            if number % 3 != 2:
                victims.append(process.pid)
            for victim in victims:
                os.kill(victim, signal.SIGKILL)
            if process.pid in victims:
                process, url = serve()
        until(lambda: idle(queue))
        jobs = queue.jobs()
        found = {each.row.submission: plain(each.row.plain()) for each in board.standings()}
    assert [(job.state, job.reason) for job in jobs] == [("done", None)] * SUBMISSIONS
    assert found == expected(digests)
    print("attempts:", {job.name: job.attempt for job in jobs})
