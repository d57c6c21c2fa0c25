import contextlib
import os
import sys
from dataclasses import replace
from pathlib import Path

import pytest
from colift.agents.isolation import process
from colift.agents.isolation.ladder import rungs
from colift.agents.isolation.launch import command
from colift.agents.isolation.limits import MIB, Limits
from colift.agents.isolation.sandboxed import close_sandboxes

PATIENT = Limits(
    memory=150 * MIB,
    processes=24,
    files=64,
    file_size=4 * MIB,
    cpu_seconds=60,
    start_seconds=60.0,
    step_seconds=60.0,
    episode_seconds=120.0,
)
"""Small, but with all the time that a busy machine may need."""

HURRIED = replace(PATIENT, start_seconds=2.0, step_seconds=0.3, episode_seconds=3.0)
"""For policies that a budget of time must stop."""


ALONE = "landlock alone"
"""Landlock where namespaces cannot be had, as in most containers."""

_CONFINED = """
import os, sys
from colift.agents.isolation import linux, seccomp
linux.forbid_new_privileges()
assert seccomp.install()
os.execv(sys.argv[1], sys.argv[1:])
"""
"""Starts a program that may not make namespaces or mounts: the policies' own filter, one above."""


@contextlib.contextmanager
def without_namespaces():
    """Start fork servers that cannot make namespaces."""

    def confined(*arguments, **keywords):
        return [sys.executable, "-c", _CONFINED, *command(*arguments, **keywords)]

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(process, "command", confined)
        yield


@pytest.fixture(scope="module", params=["bubblewrap", "landlock", ALONE, "limits"])
def way(request):
    """Each way to isolate that works here: the rungs, and Landlock alone."""
    rung = request.param.split()[0]
    if rung not in rungs():
        pytest.skip(f"{rung} does not work here")
    with without_namespaces() if request.param == ALONE else contextlib.nullcontext():
        yield request.param
    close_sandboxes()


@pytest.fixture(scope="module")
def rung(way):
    """The rung of the way."""
    return way.split()[0]


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
    """Return how many files this process has open."""
    return len(list(Path("/proc/self/fd").iterdir()))
