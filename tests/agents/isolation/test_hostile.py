"""Hostile policies: each is contained, and leaves the machine and the others as they were."""

import os
import re
import socket
import sys
import time
from pathlib import Path

import numpy as np
import pytest
from colift.agents.agent import Explaining
from colift.agents.errors import PolicyError
from colift.agents.isolation.ladder import strongest
from colift.agents.isolation.sandboxed import SandboxedPolicy

from .conftest import HURRIED, PATIENT, children, handles
from .hostile.actions import ACTIONS
from .hostile.ends import ENDS
from .hostile.frames import FRAMES
from .hostile.others import OTHERS
from .hostile.resources import RESOURCES
from .hostile.secrets import SECRETS
from .hostile.state import STATE
from .hostile.time import TIME

WALLED = [*TIME, *RESOURCES, *ENDS, *SECRETS, *OTHERS, *STATE]
"""What the walls must contain."""

ANSWERS = [*ACTIONS, *FRAMES]
"""What the scoring side must refuse, whatever the walls."""

STEPS = 40

GOOD = """
import random, time
import numpy as np

class Good:
    def reset(self, seed):
        self.rng = np.random.default_rng(seed)
        self.sum = 0.0

    def act(self, observation):
        self.sum += float(np.linalg.norm(observation)) + 0 * time.monotonic() * random.random()
        return np.array([0.1 * self.sum + self.rng.normal(0.0, 0.01)])

    def internals(self):
        return {"prediction": self.sum}
"""


def observations():
    rng = np.random.default_rng(7)
    return rng.normal(0.0, 0.1, (STEPS, 5))


def drive(agent):
    """Return the actions of an agent, and why it failed."""
    actions = []
    try:
        agent.reset(42)
        for observation in observations():
            actions.append(agent.act(observation).tolist())
    except PolicyError as error:
        return actions, str(error)
    return actions, None


@pytest.fixture(scope="module")
def board(tmp_path_factory):
    """A board's directory: a secret, a submission beside, and the submission at hand."""
    board = tmp_path_factory.mktemp("board")
    (board / "secret").write_text("hidden seeds")
    (board / "other").mkdir()
    (board / "other" / "policy.py").write_text("secret")
    folder = board / "mine"
    folder.mkdir()
    (folder / "good.py").write_text(GOOD)
    abstract = f"colift-{os.getpid()}"
    with (
        socket.create_server(("127.0.0.1", 0)) as listening,
        socket.socket(socket.AF_UNIX) as local,
        pytest.MonkeyPatch.context() as patch,
    ):
        local.bind(f"\0{abstract}")
        local.listen()
        patch.setenv("COLIFT_SECRET", "hidden")
        values = {
            "secret": board / "secret",
            "other": board / "other" / "policy.py",
            "board": board,
            "suite": Path(sys.modules["colift.agents"].__file__).parents[1] / "benchmark/suite.py",
            "process": os.getpid(),
            "port": listening.getsockname()[1],
            "abstract": abstract,
        }
        for each in (*WALLED, *ANSWERS):
            (folder / file_of(each)).write_text(each.source(**values))
        yield board


@pytest.fixture(scope="module")
def expected(board):
    """What the good policy does in this process."""
    scope = {}
    exec(GOOD, scope)
    agent = scope["Good"]()
    return drive(agent)[0]


def sandboxed(board, rung, place, limits=PATIENT):
    return SandboxedPolicy(name=place, place=place, folder=board / "mine", rung=rung, limits=limits)


def content(board):
    return {path: path.read_bytes() for path in sorted(board.rglob("*")) if path.is_file()}


@pytest.fixture(scope="module")
def walls(board, expected, way, rung):
    """A rung, after sandboxes of all limits have been made by it: what they need is there."""
    warm(board, expected, rung)
    return rung


@pytest.fixture(scope="module")
def strong(board, expected):
    """The strongest rung, likewise."""
    warm(board, expected, strongest())
    return strongest()


def warm(board, expected, rung):
    for limits in (PATIENT, HURRIED):
        assert drive_in(sandboxed(board, rung, "good.py:Good", limits)) == (expected, None)


@pytest.mark.parametrize("policy", WALLED, ids=lambda policy: policy.name)
def test_is_contained(board, expected, way, walls, policy):
    if way in policy.escapes:
        pytest.skip(policy.needs)
    contained(board, expected, walls, policy)


@pytest.mark.parametrize("policy", ANSWERS, ids=lambda policy: policy.name)
def test_an_answer_that_is_none_is_refused(board, expected, strong, policy):
    contained(board, expected, strong, policy)


def contained(board, expected, rung, policy):
    """Fail unless a policy ends as it must, and leaves all else as it was."""
    limits = HURRIED if policy.hurried else PATIENT
    good = sandboxed(board, rung, "good.py:Good")
    bad = sandboxed(board, rung, f"{file_of(policy)}:Policy", limits)
    files, before, opened = content(board), children(), handles()
    for _ in range(2 if "state" in policy.name else 1):
        with bad.agent() as agent:
            actions, failure = drive(agent)
        output = agent.printed
        if policy.reason:
            assert failure is not None, "it was not stopped"
            assert re.fullmatch(policy.reason, failure, re.DOTALL), (failure, output)
        else:
            assert failure is None, output
            assert actions == STEPS * [[0.0]]
        assert re.search(policy.output, output), output
        assert len(output) <= 10_000
    assert drive_in(good) == (expected, None)
    assert content(board) == files
    assert settled(before)
    assert handles() == opened


def file_of(policy):
    """Return the name of a policy's file."""
    return re.sub(r"\W+", "_", policy.name) + ".py"


def settled(before, seconds=5.0):
    """Whether there come to be no more processes than before."""
    end = time.monotonic() + seconds
    while children() - before and time.monotonic() < end:
        time.sleep(0.01)
    return not children() - before


def drive_in(policy):
    with policy.agent() as agent:
        assert isinstance(agent, Explaining)
        return drive(agent)


def test_names_are_distinct():
    files = [file_of(each) for each in (*WALLED, *ANSWERS)]
    assert len(set(files)) == len(files)
