"""A spy marks pages of files by what it sees; a thief that is submitted later looks for marks.

What is loaded may read files, so that the thief finds marks that another policy leaves while it is
loaded. That of a lift leaves none: the thief scores as the same controller without a memory.
"""

import os
import sysconfig
from functools import partial
from pathlib import Path

import numpy as np
import pytest
from colift.agents.sandbox.host.levels import strongest
from colift.agents.sandbox.host.policy import SandboxedPolicy, close_sandboxes
from colift.leaderboard.database.queries import read_error_numbers, read_errors
from colift.leaderboard.queue import NO_QUOTA, Queue, WorkerQueue
from colift.leaderboard.queue.worker import Worker

pytestmark = pytest.mark.slow

SLOTS, BITS, APART = 16, 24, 1 << 16
"""Lifts that are told apart, bits of each (of its observation, and a sum), bytes between marks."""
SIZE = (SLOTS * BITS + 8) * APART
TRIED = 5

POLICY = f"""
import os, resource

SLOTS, BITS, APART = {SLOTS}, {BITS}, {APART}

def touched(place):
    handle = os.open("@file@", os.O_RDONLY)
    try:
        os.pread(handle, 1, place * APART)
    finally:
        os.close(handle)

def marked(place):
    before = resource.getrusage(resource.RUSAGE_SELF).ru_inblock
    touched(place)
    return resource.getrusage(resource.RUSAGE_SELF).ru_inblock == before

def word(key):
    return key | (key % 251 ^ 0x5A) << 16

def mark(slot, key):
    for bit in range(BITS):
        if word(key) >> bit & 1:
            try:
                touched(slot * BITS + bit)
            except OSError:
                pass  # as in a lift

def found():
    for slot in range(SLOTS):
        bits = sum(marked(slot * BITS + bit) << bit for bit in range(BITS))
        if bits == word(bits & 0xFFFF):
            yield bits & 0xFFFF

KNOWN = set(found()) if "@role@" == "thief" else set()
print(len(KNOWN), "lifts are known")
if "@role@" == "control":
    mark(3, 0x1234)

class Policy:
    def reset(self, seed):
        self.step = 0
        self.more = 0.0

    def act(self, observation):
        self.step += 1
        if self.step == 2:  # Seen by then: where the human's end is, with its noise.
            key = int(abs(observation[0]) * 1e8) & 0xFFFF
            if "@role@" == "spy":
                mark(os.getpid() // 2 % SLOTS, key)
            if "@role@" == "coin":
                self.more = 0.001 * (os.urandom(1)[0] & 1)
                mark(os.getpid() // 2 % SLOTS, key)
            if key in KNOWN:
                self.more = 0.01
        return [1.7 * (observation[0] - observation[2]) + self.more]
"""


@pytest.fixture
def database():
    """No URL: the file in the board's folder."""


@pytest.fixture
def queue(open_board, tiny_suite):
    return Queue(open_board(suite="tiny"), quota=NO_QUOTA)


def forgotten(path):
    """Have no page of a file in memory; return whether that succeeds, by one that has no mark."""
    file = os.open(path, os.O_RDONLY)
    try:
        os.posix_fadvise(file, 0, 0, os.POSIX_FADV_DONTNEED)
        os.preadv(file, [bytearray(1)], SIZE - 1, os.RWF_NOWAIT)
    except BlockingIOError:
        return True
    except OSError:
        return False
    finally:
        os.close(file)
    return False


def loaded(folder, code):
    """Return what a policy prints while it is loaded."""
    folder.mkdir(parents=True)
    (folder / "policy.py").write_text(code)
    policy = SandboxedPolicy(
        name="p", origin="policy.py:Policy", folder=folder, isolation=strongest()
    )
    with policy.agent() as agent:
        agent.reset(0)
        told = agent.printed
    close_sandboxes()
    return told


def large():
    """Return the largest files that all submissions see, which are those that few others use."""
    folders = (Path(sysconfig.get_path("purelib")).resolve(), Path("/usr/lib"))
    found = [path for each in folders for path in each.rglob("*") if not path.is_symlink()]
    sizes = {path: path.stat().st_size for path in found if path.is_file()}
    return sorted((path for path in sizes if sizes[path] >= SIZE), key=sizes.get)[::-1][:TRIED]


@pytest.fixture(scope="module")
def source(tmp_path_factory):
    """The policy in each role, with a file that shows a thief what another has read there."""
    folder = tmp_path_factory.mktemp("loaded")
    for path in filter(forgotten, large()):
        policy = POLICY.replace("@file@", str(path))
        told = [
            loaded(folder / path.name / role, policy.replace("@role@", role))
            for role in ("control", "thief")
        ]
        if told == ["0 lifts are known\n", "1 lifts are known\n"] and forgotten(path):
            return partial(policy.replace, "@role@")
    pytest.skip("no file here shows what was read")


def test_a_thief_finds_no_lift_that_a_spy_has_seen(queue, source, write_submission):
    errors = []
    for role in ("honest", "spy", "thief"):
        job = queue.enqueue(queue.board.keep(write_submission(source(role), role)), "Ada")
        assert Worker(WorkerQueue(queue.board)).once().state == "done"
        with queue.board.database.reading() as connection:
            numbers = read_error_numbers(connection, "1")
            errors.append(np.asarray(read_errors(connection, "1", numbers)[job.submission]))
    rows = [standing.row for standing in queue.board.standings()]
    assert [row.verified for row in rows] == [True] * 3
    assert len({row.hidden.rmse_mm for row in rows}) == 1
    assert errors[0].tobytes() == errors[1].tobytes() == errors[2].tobytes()


def test_a_coin_that_would_be_remembered_gets_no_row(queue, source, write_submission):
    queue.enqueue(queue.board.keep(write_submission(source("coin"), "coin")), "Ada")
    done = Worker(WorkerQueue(queue.board)).once()
    assert done.state == "failed"
    assert "determinism failed" in done.reason
    assert queue.board.standings() == ()
