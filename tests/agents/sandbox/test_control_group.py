import os
import signal
import subprocess
import sys

import pytest
from colift.agents.sandbox.host.control_group import ControlGroup
from colift.agents.sandbox.host.levels import strongest
from colift.agents.sandbox.host.process import HEADROOM, ForkServer
from colift.agents.sandbox.protocol import MIB, Limits

FILLS = "block = bytearray(1 << 28); print(len(block))"
SHARES = """
import mmap, os
for _ in range(4):
    if os.fork() == 0:
        shared = mmap.mmap(-1, 1 << 26)
        shared.write(b"x" * (1 << 26))
        os._exit(0)
held = []
while True:
    held.append(os.open("/dev/shm", os.O_TMPFILE | os.O_RDWR))
    os.write(held[-1], b"x" * (1 << 24))
"""


@pytest.fixture
def group():
    try:
        made = ControlGroup(96 * MIB)
    except OSError as error:
        pytest.skip(f"this process may make no control group: {error}")
    yield made
    made.remove()
    assert not made.folder.exists()


def test_what_fits_runs(group):
    command = group.entering([sys.executable, "-c", "print('fits')"])
    assert subprocess.run(command, capture_output=True, check=True).stdout == b"fits\n"


@pytest.mark.parametrize("script", [FILLS, SHARES])
def test_all_memory_counts_that_processes_have_together(group, script):
    done = subprocess.run(group.entering([sys.executable, "-c", script]), capture_output=True)
    assert done.returncode == -signal.SIGKILL


def test_a_group_left_by_a_killed_owner_is_removed_by_the_next(group):
    ended = subprocess.Popen([sys.executable, "-c", ""])
    ended.wait()
    left = group.folder.with_name(f"colift-{ended.pid}-0")
    left.mkdir()
    ControlGroup(MIB).remove()
    assert not left.exists()


def test_a_sandbox_is_in_a_group_has_one_for_lifts_and_takes_both_away(group):
    limits = Limits(memory=100 * MIB)
    mine = f"colift-{os.getpid()}-*"
    before = set(group.folder.parent.glob(mine))
    server = ForkServer(strongest(), None, limits)
    try:
        made = set(group.folder.parent.glob(mine)) - before
        assert sorted(bool((own / "cgroup.procs").read_text()) for own in made) == [False, True]
        for own in made:
            names = (own / "memory.max", own / "memory.limit_in_bytes")
            limit = next(name for name in names if name.exists())
            assert int(limit.read_text()) == limits.memory + HEADROOM
    finally:
        server.close()
    assert set(group.folder.parent.glob(mine)) == before
