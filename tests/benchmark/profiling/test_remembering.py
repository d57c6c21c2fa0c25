"""The time that a lift takes is measured as a policy could measure it."""

import pytest
from colift.agents.sandbox.host.policy import SandboxedPolicy, close_sandboxes
from colift.benchmark.profiling.remembering import bits_of_time


@pytest.mark.parametrize("level", ["limits", "landlock"])
def test_a_lift_passes_on_some_bits_and_not_many(level, need_level):
    need_level(level)
    policy = SandboxedPolicy(name="any", origin="colift.agents.policies.hold:Hold", isolation=level)
    bits = bits_of_time(policy, lifts=4)
    close_sandboxes()
    assert 0 < bits < 30
