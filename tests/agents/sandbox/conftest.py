import gc
import os
import sys
from contextlib import suppress
from dataclasses import replace
from pathlib import Path

import pytest
from colift.agents.sandbox.guest import filters
from colift.agents.sandbox.host import process
from colift.agents.sandbox.host.policy import close_sandboxes
from colift.agents.sandbox.host.process import command
from colift.agents.sandbox.protocol import MIB, Limits

PATIENT = Limits(
    memory=150 * MIB,
    processes=24,
    files=64,
    file_size=4 * MIB,
    cpu_seconds=60,
    start_seconds=60.0,
    step_periods=600.0,
    pace_periods=600.0,
)
"""Small, but with all the time that a busy machine may need."""

SPARING = replace(PATIENT, cpu_seconds=1, file_size=100 * MIB)
"""For policies that a budget of all their processes or files must stop."""

HURRIED = replace(PATIENT, start_seconds=2.0, step_periods=3.0, pace_periods=0.2)
"""For policies that a budget of time must stop."""


_CONFINED = """
import ctypes, os, struct, sys
program = ctypes.create_string_buffer(bytes.fromhex(sys.argv[1]))
head = struct.pack("HP", len(program) // 8, ctypes.addressof(program))
prctl = ctypes.CDLL(None).prctl
if prctl(38, 1, 0, 0, 0) or prctl(22, 2, ctypes.create_string_buffer(head), 0, 0):
    sys.exit("no filter")
os.execv(sys.argv[2], sys.argv[2:])
"""
"""Starts a program under a filter of system calls."""

_UNSHARE = {"x86_64": 272, "aarch64": 97}[os.uname().machine]
_NO_NAMESPACES = (
    filters.instruction(0x20, 0)
    + filters.instruction(0x15, _UNSHARE, no=1)
    + filters.instruction(0x06, 0x00050001)
    + filters.instruction(0x06, 0x7FFF0000)
)
"""Refuses to make namespaces, as in most containers."""


@pytest.fixture
def _without_namespaces():
    """Start fork servers that cannot make namespaces."""

    def confined(*arguments, **keywords):
        return [
            sys.executable,
            "-c",
            _CONFINED,
            _NO_NAMESPACES.hex(),
            *command(*arguments, **keywords),
        ]

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(process, "command", confined)
        yield
    close_sandboxes()


@pytest.fixture(scope="module")
def level(each_level):
    """Each level that works here."""
    yield each_level
    close_sandboxes()


@pytest.fixture(autouse=True, scope="module")
def _no_sandbox_left():
    yield
    close_sandboxes()


def children():
    """Return the processes that descend from this one."""
    found, family = {}, {os.getpid()}
    for entry in Path("/proc").iterdir():
        if entry.name.isdigit():
            try:
                words = (entry / "stat").read_text().rpartition(")")[2].split()
            except OSError:
                continue
            found[int(entry.name)] = int(words[1])
    size = 0
    while len(family) > size:
        size = len(family)
        family |= {each for each, parent in found.items() if parent in family}
    return family - {os.getpid()}


def handles():
    """Return what files this process has open: (number, file)."""
    found = set()
    for entry in Path("/proc/self/fd").iterdir():
        with suppress(FileNotFoundError):  # that of the listing itself
            found.add((entry.name, entry.readlink()))
    return found


def opened_since(before):
    """Return what files were opened and not closed, without those of what nobody refers to."""
    gc.collect()
    return handles() - before
