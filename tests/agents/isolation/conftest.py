import os
from dataclasses import replace
from pathlib import Path

import pytest
from colift.agents.isolation.ladder import rungs
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


@pytest.fixture(scope="module", params=["bubblewrap", "landlock", "limits"])
def rung(request):
    """Each rung that works here."""
    if request.param not in rungs():
        pytest.skip(f"{request.param} does not work here")
    return request.param


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
    return len(os.listdir("/proc/self/fd"))
