"""State that survives from episode to episode through what was made on import is found."""

import dataclasses

import pytest
from colift.agents.isolation.ladder import rungs
from colift.agents.isolation.sandboxed import SandboxedPolicy, close_sandboxes
from colift.benchmark.audit import STATE, audit
from colift.benchmark.runner import run_suite
from colift.benchmark.suite import make_suite

pytestmark = pytest.mark.skipif("bubblewrap" not in rungs(), reason="needs bubblewrap")

SECRET = bytes(32)

HEAD = """
import mmap, os, socket, threading

class Policy:
    def reset(self, seed): self.shift = count()
    def act(self, observation):
        return [0.3 * (observation[0] - observation[2]) + 1e-6 * self.shift]
"""

KEEPERS = {
    "nothing": "def count(): return 0",
    "module": """
seen = 0
def count():
    global seen
    seen += 1
    return seen
""",
    "shared memory": """
shared = mmap.mmap(-1, 4096)
def count():
    shared[0] += 1
    return shared[0]
""",
    "pipe": """
reading, writing = os.pipe()
os.write(writing, bytes(1))
def count():
    seen = os.read(reading, 1)[0]
    os.write(writing, bytes([seen + 1]))
    return seen
""",
    "process": """
ours, theirs = socket.socketpair(socket.AF_UNIX, socket.SOCK_SEQPACKET)
if os.fork() == 0:
    for seen in range(250):
        theirs.recv(1)
        theirs.send(bytes([seen]))
    os._exit(0)
def count():
    ours.send(b"?")
    return ours.recv(1)[0]
""",
}


@pytest.fixture
def policy(tmp_path):
    def written(keeper):
        (tmp_path / "policy.py").write_text(HEAD + KEEPERS[keeper])
        return SandboxedPolicy(name="p", place="policy:Policy", folder=tmp_path, preload=True)

    yield written
    close_sandboxes()


@pytest.mark.parametrize("keeper", KEEPERS)
def test_a_run_that_was_forked_is_compared_with_fresh_processes(policy, keeper):
    preloaded = policy(keeper)
    run = run_suite(preloaded, make_suite("quick-v1").with_seeds(0, 1))
    assert [episode.failure for episode in run.episodes] == 4 * [None]
    finding = audit(dataclasses.replace(preloaded, preload=False), run, SECRET)
    if keeper in ("nothing", "module"):  # A fork's own variables die with it.
        assert finding is None
    else:
        assert finding.reason == STATE
        assert finding.step == 0
