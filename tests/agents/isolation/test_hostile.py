import importlib.util
import os
import re
import signal
import socket
import sys
import time
from pathlib import Path

import numpy as np
import pytest
from colift.agents.agent import Explaining
from colift.agents.errors import PolicyError
from colift.agents.isolation.ladder import VERIFIABLE
from colift.agents.isolation.sandboxed import SandboxedPolicy

_here = Path(__file__).parent


def _beside(name):
    spec = importlib.util.spec_from_file_location(f"isolation_{name}", _here / f"{name}.py")
    module = importlib.util.module_from_spec(spec)
    sys.modules[spec.name] = module
    spec.loader.exec_module(module)
    return module


HOSTILE = _beside("hostile").HOSTILE
from_conftest = _beside("conftest")
PATIENT, HURRIED = from_conftest.PATIENT, from_conftest.HURRIED
children, handles = from_conftest.children, from_conftest.handles

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
        for number, hostile in enumerate(HOSTILE):
            (folder / f"p{number}.py").write_text(hostile.source(**values))
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


@pytest.fixture(scope="module")
def warm(board, rung):
    """The sandboxes of a rung, running before anything is counted."""
    for limits in (PATIENT, HURRIED):
        with sandboxed(board, rung, "good.py:Good", limits).agent():
            pass


def content(board):
    return {path: path.read_bytes() for path in sorted(board.rglob("*")) if path.is_file()}


@pytest.mark.parametrize("number", range(len(HOSTILE)), ids=[each.name for each in HOSTILE])
def test_is_contained(board, expected, warm, rung, number):
    hostile = HOSTILE[number]
    if hostile.needs_walls and rung not in VERIFIABLE:
        pytest.skip(hostile.needs_walls)
    limits = HURRIED if hostile.hurried else PATIENT
    policy = sandboxed(board, rung, f"p{number}.py:Policy", limits)
    files, before, opened = content(board), children(), handles()
    for _ in range(2 if "state" in hostile.name else 1):
        with policy.agent() as agent:
            actions, failure = drive(agent)
            during = agent.output
        output = agent.output
        if hostile.reason:
            assert failure is not None, "it was not stopped"
            assert re.fullmatch(hostile.reason, failure, re.DOTALL), (failure, output)
        else:
            assert failure is None, output
            assert actions == STEPS * [[0.0]]
        assert re.search(hostile.output, output), during
        assert len(output) <= 10_000
    assert drive_in(sandboxed(board, rung, "good.py:Good")) == (expected, None)
    assert content(board) == files
    assert settled(before)
    assert handles() == opened


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
    names = [each.name for each in HOSTILE]
    assert len(set(names)) == len(names)
    assert signal.SIGKILL
