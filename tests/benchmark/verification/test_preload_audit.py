"""State that survives from episode to episode through what was made on import is found."""

import dataclasses

import pytest
from colift.agents.sandbox.host.policy import SandboxedPolicy, close_sandboxes
from colift.benchmark.execution.runner import run_suite
from colift.benchmark.suites.suite import make_suite
from colift.benchmark.verification.audit import STATE, audit

SECRET = bytes(32)

HEAD = """
import mmap, os

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
with open(os.environ["TMPDIR"] + "/shared", "w+b") as file:
    file.truncate(4096)
    shared = mmap.mmap(file.fileno(), 4096)
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
asked, asking = os.pipe()
told, telling = os.pipe()
if os.fork() == 0:
    for seen in range(250):
        os.read(asked, 1)
        os.write(telling, bytes([seen]))
    os._exit(0)
def count():
    os.write(asking, b"?")
    return os.read(told, 1)[0]
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
