"""A lift leaves no mark on files: no page, no name, no time that was not there before."""

import ctypes
import mmap
import os
from dataclasses import replace

import numpy as np
import pytest
from colift.agents.sandbox.host.control_group import ControlGroup
from colift.agents.sandbox.host.policy import SandboxedPolicy, close_sandboxes
from colift.agents.sandbox.protocol import MIB

from .conftest import PATIENT

PAGES = 64

MARKING = """
import mmap, os
from pathlib import Path

class Marking:
    def __init__(self):
        self.file = os.open("marks", os.O_RDONLY)
        os.set_inheritable(self.file, True)
        os.dup2(self.file, 9)

    def reset(self, seed):
        pass

    def act(self, observation):
        refused = 0
        for page in range(64):
            for attempt in (
                lambda: os.pread(self.file, 1, 4096 * page),
                lambda: os.pread(9, 1, 4096 * page),
                lambda: Path("marks").read_bytes(),
                lambda: mmap.mmap(self.file, 4096, offset=4096 * page, flags=mmap.MAP_PRIVATE),
            ):
                try:
                    attempt()
                except OSError:
                    refused += 1
        return [float(refused)]
"""


@pytest.fixture
def marks(tmp_path):
    """A file of which no page is in memory, where that can be had."""
    path = tmp_path / "marks"
    with path.open("wb") as file:
        file.write(os.urandom(PAGES * mmap.PAGESIZE))
        os.fsync(file.fileno())
        os.posix_fadvise(file.fileno(), 0, 0, os.POSIX_FADV_DONTNEED)
    if in_memory(path):
        pytest.skip("files here are always in memory")
    return path


def in_memory(path):
    """Return the pages of a file that are in memory, without reading any."""
    size = path.stat().st_size
    pages = ctypes.create_string_buffer(size // mmap.PAGESIZE)
    libc = ctypes.CDLL(None, use_errno=True)
    libc.mmap.restype = ctypes.c_void_p
    with path.open("rb") as file:
        length = ctypes.c_size_t(size)
        place = ctypes.c_void_p(
            libc.mmap(None, length, mmap.PROT_READ, mmap.MAP_SHARED, file.fileno(), 0)
        )
        assert libc.mincore(place, length, pages) == 0
        assert libc.munmap(place, length) == 0
    return {page for page, byte in enumerate(pages.raw) if byte & 1}


def test_a_lift_reads_no_page(tmp_path, marks, each_level):
    (tmp_path / "policy.py").write_text(MARKING)
    policy = SandboxedPolicy(
        name="p", origin="policy:Marking", folder=tmp_path, isolation=each_level
    )
    with policy.agent() as agent:
        agent.reset(1)
        assert agent.act(np.zeros(5)).tolist() == [4.0 * PAGES]
    close_sandboxes()
    assert in_memory(marks) == set()


MAPPING = """
import mmap

class Mapping:
    def reset(self, seed):
        with open("marks", "rb") as file:
            self.pages = mmap.mmap(file.fileno(), 0, mmap.MAP_PRIVATE, mmap.PROT_READ)

    def act(self, observation):
        return [float(self.pages[4096 * int(observation[0])])]
"""


def test_what_is_mapped_is_in_memory_before_the_first_lift(tmp_path, marks, each_level):
    (tmp_path / "policy.py").write_text(MAPPING)
    policy = SandboxedPolicy(
        name="p", origin="policy:Mapping", folder=tmp_path, isolation=each_level
    )
    with policy.agent() as agent:
        agent.reset(1)
        assert in_memory(marks) == set(range(PAGES))
        content = marks.read_bytes()[:: mmap.PAGESIZE]
        assert [agent.act(np.full(5, float(page)))[0] for page in (3, 60)] == [
            content[3],
            content[60],
        ]
    close_sandboxes()


FILLING = """
class Filling:
    def reset(self, seed):
        with open("marks", "rb") as file:
            while file.read(1 << 20):
                pass

    def act(self, observation):
        block = bytearray(int(observation[0]))
        return [float(block[-1])]
"""


@pytest.fixture
def _groups():
    try:
        ControlGroup(MIB).remove()
    except OSError as error:
        pytest.skip(f"this process may make no control group: {error}")


@pytest.mark.slow
@pytest.mark.usefixtures("_groups")
def test_the_memory_that_a_lift_takes_is_not_that_of_files(tmp_path, each_level):
    """Files, a lift and the sandbox need more than its control group has together.

    Some machines drop pages of their own accord: then it is tried again, with other files.
    """
    assert any(keep_all_pages(tmp_path / str(trial), each_level) for trial in range(6))


def keep_all_pages(folder, level):
    """Whether two lifts that take much memory leave all pages of a file where they are."""
    folder.mkdir()
    with (folder / "marks").open("wb") as file:
        file.truncate(420 * MIB)
    (folder / "policy.py").write_text(FILLING)
    limits = replace(PATIENT, memory=300 * MIB)
    policy = SandboxedPolicy(
        name="p", origin="policy:Filling", folder=folder, isolation=level, limits=limits
    )
    with policy.agent() as agent:
        agent.reset(1)
        read = in_memory(folder / "marks")
        assert len(read) > 350 * MIB / mmap.PAGESIZE
        for size in (100 * MIB, 200 * MIB):
            agent.reset(1)
            agent.act(np.full(5, float(size)))
        kept = in_memory(folder / "marks")
    close_sandboxes()
    (folder / "marks").unlink()
    return kept == read
