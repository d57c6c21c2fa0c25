"""Hostile policies: each is contained, and leaves the machine and the others as they were."""

import os
import re
import socket
import time
from dataclasses import replace
from inspect import getsourcefile

import numpy as np
import pytest
from colift.agents.agent import Explaining
from colift.agents.sandbox.host.levels import strongest
from colift.agents.sandbox.host.policy import SandboxedPolicy, kept_sandboxes
from colift.base.errors import PolicyError
from colift.benchmark.suites.suite import Suite

from .conftest import HURRIED, PATIENT, SPARING, children, handles, opened_since
from .hostile.actions import ACTIONS
from .hostile.ends import ENDS
from .hostile.frames import FRAMES
from .hostile.gate import GATE
from .hostile.inside import INSIDE
from .hostile.kept import KEPT
from .hostile.others import OTHERS
from .hostile.resources import RESOURCES
from .hostile.secrets import SECRETS
from .hostile.state import STATE
from .hostile.time import TIME

pytestmark = pytest.mark.slow

RESTRICTED = [*TIME, *RESOURCES, *ENDS, *SECRETS, *OTHERS, *STATE, *KEPT, *INSIDE, *GATE]
"""What the restrictions must contain."""

ANSWERS = [*ACTIONS, *FRAMES]
"""What the scoring side must refuse, whatever the restrictions."""

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
    (folder / "accessed").write_text("x")
    abstract = f"colift-{os.getpid()}"
    with (
        socket.create_server(("127.0.0.1", 0)) as listening,
        socket.socket(socket.AF_UNIX) as local,
        socket.socket(socket.AF_UNIX) as named,
        pytest.MonkeyPatch.context() as patch,
    ):
        local.bind(f"\0{abstract}")
        local.listen()
        named.bind(str(board / "socket"))
        named.listen()
        patch.setenv("COLIFT_SECRET", "hidden")
        values = {
            "secret": board / "secret",
            "other": board / "other" / "policy.py",
            "board": board,
            "suite": getsourcefile(Suite),
            "process": os.getpid(),
            "port": listening.getsockname()[1],
            "abstract": abstract,
            "local": board / "socket",
            "processors": os.cpu_count(),
        }
        for each in (*RESTRICTED, *ANSWERS):
            (folder / file_of(each)).write_text(each.source(**values))
        yield board


@pytest.fixture(scope="module")
def expected(board):
    """What the good policy does in this process."""
    scope = {}
    exec(GOOD, scope)
    agent = scope["Good"]()
    return drive(agent)[0]


def sandboxed(board, level, place, limits=PATIENT):
    return SandboxedPolicy(
        name=place, origin=place, folder=board / "mine", isolation=level, limits=limits
    )


def content(board):
    return {path: path.read_bytes() for path in sorted(board.rglob("*")) if path.is_file()}


@pytest.fixture(scope="module")
def ready(board, expected, level):
    """A level, after sandboxes of all limits have been made by it: what they need is there."""
    warm(board, expected, level)
    return level


@pytest.fixture(scope="module")
def strong(board, expected):
    """The strongest level, likewise."""
    warm(board, expected, strongest())
    return strongest()


def warm(board, expected, level):
    for limits in (PATIENT, HURRIED, SPARING):
        found = drive_in(sandboxed(board, level, "good.py:Good", limits))
        # A busy machine may not keep a good policy within the budget of time.
        assert found == (expected, None) or limits is HURRIED


@pytest.mark.parametrize("policy", RESTRICTED, ids=lambda policy: policy.name)
def test_is_contained(board, expected, ready, policy):
    if ready == "limits" and policy.needs_namespaces:
        pytest.skip(policy.needs_namespaces)
    contained(board, expected, ready, policy)


@pytest.mark.parametrize("policy", ANSWERS, ids=lambda policy: policy.name)
def test_an_answer_that_is_none_is_refused(board, expected, strong, policy):
    contained(board, expected, strong, policy)


def contained(board, expected, level, policy):
    """Fail unless a policy ends as it must, and leaves all else as it was."""
    limits = HURRIED if policy.hurried else SPARING if policy.sparing else PATIENT
    good = sandboxed(board, level, "good.py:Good")
    bad = sandboxed(board, level, f"{file_of(policy)}:Policy", limits)
    drop_cells()
    files, before, opened = content(board), children(), handles()
    os.utime(board / "mine" / "accessed", (1, 2))
    for again in range(2 if "state" in policy.name else 1):
        actions, failure, output = ended(replace(bad, instance=str(again)), policy)
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
    drop_cells()
    assert settled(before)
    assert not opened_since(opened)


def ended(bad, policy):
    """Return the actions of a policy, why it failed, and what it printed.

    On a busy machine another budget of time may stop it first: then it is tried again.
    """
    for _ in range(4):
        with bad.agent() as agent:
            actions, failure = drive(agent)
        another = re.match("no answer within|took more than", failure or "")
        if not (policy.hurried and another) or re.fullmatch(policy.reason, failure, re.DOTALL):
            break
    return actions, failure, agent.printed


def drop_cells():
    """End the processes of policies; the trusted ones that start them go on."""
    for sandbox in kept_sandboxes():
        sandbox.drop()


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
    files = [file_of(each) for each in (*RESTRICTED, *ANSWERS)]
    assert len(set(files)) == len(files)
