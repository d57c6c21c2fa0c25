"""A policy is loaded once, and each lift is a fork of what was loaded."""

import subprocess
import sys
from dataclasses import replace

import numpy as np
import pytest
from colift.agents.sandbox.host.policy import SandboxedPolicy, close_sandboxes
from colift.agents.submissions.choice import choose_policy
from colift.agents.submissions.new import write_template
from colift.base.errors import PolicyError
from colift.base.registry import POLICIES, own_entries
from colift.benchmark.execution.playing import play
from colift.benchmark.suites.suite import make_suite

from .keeping import COUNTING

pytestmark = pytest.mark.slow

POLICY = """
import os, time

print("imported")
STARTED = float(time.monotonic_ns())
seen = 0.0

class Started:
    def reset(self, seed): pass
    def act(self, observation): return [STARTED]

class Counting:
    '''Counts its lifts in a module's variable.'''
    def reset(self, seed): pass
    def act(self, observation):
        global seen
        seen += 1.0
        return [seen]

class Resetting:
    '''Counts its resets.'''
    resets = 0
    def reset(self, seed):
        Resetting.resets += 1
        print("seed", seed)
    def act(self, observation): return [float(self.resets)]

class Coin:
    def reset(self, seed): pass
    def act(self, observation): return [int.from_bytes(os.urandom(4)) / 2**32]

class Dying:
    def reset(self, seed): pass
    def act(self, observation): os._exit(3)

class Reading:
    def reset(self, seed): pass
    def act(self, observation):
        return [len(open(__file__).read())]  # here it reads
"""


@pytest.fixture
def policy(tmp_path, each_level):
    """A policy: it means the same at every level."""

    def policy(name, source=POLICY):
        (tmp_path / "policy.py").write_text(source)
        return SandboxedPolicy(
            name=name, origin=f"policy:{name}", folder=tmp_path, isolation=each_level
        )

    yield policy
    close_sandboxes()


def action(policy, seed=1):
    """Return the first action of a new episode."""
    with policy.agent() as agent:
        agent.reset(seed)
        return agent.act(np.zeros(5)).tolist()[0]


def test_the_module_is_imported_once(policy):
    started = policy("Started")
    assert action(started) == action(started)


def test_another_instance_is_loaded_anew(policy):
    started = policy("Started")
    assert action(started) != action(replace(started, instance="another"))


def test_what_an_episode_does_to_the_module_ends_with_it(policy):
    counting = policy("Counting")
    assert [action(counting) for _ in range(3)] == [1.0, 1.0, 1.0]


def test_a_policy_is_reset_once_for_each_seed(policy):
    resetting = policy("Resetting")
    assert [action(resetting, seed) for seed in (1, 1, 2, 1)] == [1.0] * 4


def test_episodes_of_one_agent_are_forked_one_after_the_other(policy):
    with policy("Counting").agent() as agent:
        for _ in range(3):
            agent.reset(1)
            assert [agent.act(np.zeros(5))[0] for _ in range(2)] == [1.0, 2.0]


def test_two_agents_at_a_time_are_two_processes(policy):
    counting = policy("Counting")
    with counting.agent() as one, counting.agent() as other:
        for agent in (one, other):
            agent.reset(1)
        assert [one.act(np.zeros(5))[0], other.act(np.zeros(5))[0]] == [1.0, 1.0]
        assert [one.act(np.zeros(5))[0], other.act(np.zeros(5))[0]] == [2.0, 2.0]


def test_chance_in_a_lift_is_another_in_each(policy):
    coin = policy("Coin")
    assert len({action(coin) for _ in range(3)}) == 3


def test_what_was_printed_while_it_was_loaded_is_before_what_a_lift_prints(policy):
    for _ in range(2):
        with policy("Resetting").agent() as agent:
            agent.reset(5)
            assert agent.printed == "imported\nseed 5\n"


def test_an_episode_that_ends_its_process_leaves_the_next_alone(policy):
    dying = policy("Dying")
    for _ in range(5):
        with pytest.raises(PolicyError, match=r"ended its process \(exit code 3\)"):
            action(dying)
    assert action(policy("Counting")) == 1.0


def test_a_refused_call_is_told_with_the_cure_and_its_line(policy):
    with policy("Reading").agent() as agent:
        agent.reset(1)
        with pytest.raises(PolicyError, match=r"PermissionError: .*; in a lift .* its constructor"):
            agent.act(np.zeros(5))
        assert "# here it reads" in agent.printed
        assert 'File "policy.py", line ' in agent.printed


def test_the_process_that_is_forked_can_count_its_lifts_which_is_why_there_is_an_audit(policy):
    source = COUNTING + (
        "class Policy:\n"
        "    def reset(self, seed): pass\n"
        "    def act(self, observation): return [float(lifts)]\n"
    )
    counting = policy("Policy", source)
    assert [action(counting) for _ in range(3)] == [1.0, 2.0, 3.0]
    assert action(replace(counting, instance="audit")) == 1.0


@pytest.mark.parametrize(
    ("source", "told"),
    [
        ("print('so far')\nraise ValueError('no weights')", "ValueError: no weights"),
        ("print('so far')\nimport os\nos._exit(4)", "exit code 4"),
        ("print('so far')\nraise SystemExit('bye')", "SystemExit: bye"),
        ("print('so far')", "no class 'Policy'"),
    ],
)
def test_a_module_that_cannot_be_imported_fails_every_episode_with_the_reason(policy, source, told):
    broken = policy("Policy", source)
    for _ in range(5):
        with broken.agent() as agent:
            assert told in str(agent.failure)
            assert agent.printed == "so far\n"
            with pytest.raises(PolicyError):
                agent.reset(1)


def test_a_policy_that_fails_again_and_again_is_not_loaded_for_ever(policy):
    source = "import time\nraise ValueError(time.monotonic_ns())"
    broken, told = policy("Policy", source), []
    for _ in range(6):
        with broken.agent() as agent:
            told.append(str(agent.failure))
    assert len(set(told)) == 3
    assert len(set(told[2:])) == 1


@pytest.mark.parametrize("name", own_entries(POLICIES))
def test_colifts_own_policies_act_alike_behind_the_gate(name):
    task = own_entries(POLICIES)[name].group.removeprefix(POLICIES).strip(".")
    scenario = make_suite(f"{task or 'quick'}-v1").scenarios[0]
    isolated, plain = choose_policy(name, "landlock"), choose_policy(name, "none")
    (one,), (other,) = (play(policy, scenario, (3,)) for policy in (isolated, plain))
    close_sandboxes()
    assert one.failure is other.failure is None
    assert one.trace.action.tobytes() == other.trace.action.tobytes()


LEFT_OPEN = """
import sys
from pathlib import Path
import numpy as np
from colift.agents.submissions.submission import read_submission

with read_submission(Path(sys.argv[1])).sandboxed("limits").agent() as agent:
    agent.reset(0)
    agent.act(np.zeros(5))
"""


def test_a_process_that_ends_leaves_no_socket_open(tmp_path):
    """Its sandboxes are kept for the next episode, which never comes."""
    folder = tmp_path / "mine"
    write_template(folder)
    done = subprocess.run(
        [sys.executable, "-W", "error", "-c", LEFT_OPEN, folder], capture_output=True, text=True
    )
    assert (done.returncode, done.stderr) == (0, "")
