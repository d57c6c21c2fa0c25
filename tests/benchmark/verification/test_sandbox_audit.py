"""A policy whose lifts depend on those before is found: the audit plays them in another process."""

import dataclasses

import pytest
from colift.agents.sandbox.host.policy import SandboxedPolicy, close_sandboxes
from colift.benchmark.execution.runner import run_suite
from colift.benchmark.suites.suite import make_suite
from colift.benchmark.verification.audit import AUDIT, audit

from ...agents.sandbox.keeping import COUNTING

SECRET = bytes(32)

ACT = """
class Policy:
    def reset(self, seed): pass
    def act(self, observation):
        return [0.3 * (observation[0] - observation[2]) + 1e-6 * shift()]
"""

KEEPERS = {
    "nothing": ("def shift(): return 0", False),
    "its lifts": (COUNTING + "def shift(): return lifts", True),
    "a coin of its import": ("import os; coin = os.urandom(1)[0]\ndef shift(): return coin", True),
    "a coin of each lift": ("import os\ndef shift(): return os.urandom(1)[0]", True),
    "when it was loaded": (
        "import time; then = time.time()\ndef shift(): return (time.time() - then) / 100",
        True,
    ),
}


@pytest.mark.slow
@pytest.mark.parametrize("keeper", KEEPERS)
def test_what_does_not_follow_from_the_lift_alone_is_found(tmp_path, keeper):
    source, found = KEEPERS[keeper]
    (tmp_path / "policy.py").write_text(source + ACT)
    policy = SandboxedPolicy(name="p", origin="policy:Policy", folder=tmp_path)
    run = run_suite(policy, make_suite("quick-v1").with_seeds(0, 1))
    assert [episode.failure for episode in run.episodes] == 12 * [None]
    finding = audit(dataclasses.replace(policy, instance=AUDIT), run, SECRET)
    close_sandboxes()
    assert (finding is not None) == found
