"""A session has a process of its own: what a policy keeps is there in its next lift alone."""

import dataclasses

import pytest
from colift.agents.sandbox.host.policy import SandboxedPolicy, close_sandboxes
from colift.agents.submissions.choice import choose_policy
from colift.agents.submissions.new import write_template
from colift.benchmark.execution.runner import run_suite
from colift.benchmark.suites.suite import make_suite

pytestmark = pytest.mark.slow

WHOLE = make_suite("session-v1")
SUITE = dataclasses.replace(WHOLE, scenarios=WHOLE.scenarios[:2], seeds=WHOLE.seeds[:4])

POLICY = """
import numpy as np

lifts = 0

class Policy:
    '''Counts lifts in a module, in a library, and in itself.'''
    def begin_session(self):
        self.own = 0
    def reset(self, seed):
        global lifts
        lifts += 1
        self.own += 1
        np.count = getattr(np, "count", 0) + 1
    def act(self, observation):
        return np.array([-1e-6 * (lifts + 10 * self.own + 100 * np.count)])
"""

FAILING = POLICY.replace("return np", "1 / (self.own - 2)\n        return np")
"""Fails in the second lift."""

READING = POLICY.replace(
    "        global lifts", "        global lifts\n        self.own and open(__file__)"
)
"""Reads a file in the second lift."""


@pytest.fixture
def submission(tmp_path):
    yield lambda source: _made(tmp_path / "mine", source)
    close_sandboxes()


def _made(folder, source):
    write_template(folder)
    (folder / "policy.py").write_text(source)
    return choose_policy(str(folder), "auto")


def counted(run):
    return [round(-1e6 * float(each.trace.action[:1].sum())) for each in run.episodes]


def test_what_is_kept_is_there_in_the_next_lift_and_in_no_other_session(submission):
    policy = submission(POLICY)
    assert isinstance(policy, SandboxedPolicy)
    run = run_suite(policy, SUITE)
    assert [each.failure for each in run.episodes] == [None] * 8
    assert counted(run) == 2 * [111, 222, 333, 444]
    assert counted(run_suite(policy, SUITE)) == counted(run)


def test_a_policy_that_fails_begins_again_in_the_next_lift(submission):
    run = run_suite(submission(FAILING), SUITE)
    assert counted(run) == 2 * [111, 0, 111, 0]
    assert run.episodes[1].failure == "step 0: ZeroDivisionError: division by zero"


def test_the_reset_of_a_later_lift_has_no_files(submission):
    run = run_suite(submission(READING), SUITE)
    assert run.episodes[0].failure is None
    assert run.episodes[1].failure.startswith("start: ")
    assert "in a lift a policy has no files" in run.episodes[1].failure
