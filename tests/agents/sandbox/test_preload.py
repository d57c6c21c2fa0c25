"""Policies whose module is imported once for all episodes."""

import subprocess
import sys

import numpy as np
import pytest
from colift.agents.errors import PolicyError
from colift.agents.sandbox.host.policy import SandboxedPolicy, close_sandboxes
from colift.agents.submissions.new import write_template

POLICY = """
import mmap, os, time

print("imported")
STARTED = float(time.monotonic_ns())
seen = 0.0
with open(os.environ["TMPDIR"] + "/shared", "w+b") as file:
    file.truncate(4096)
    shared = mmap.mmap(file.fileno(), 4096)

class Started:
    def reset(self, seed): pass
    def act(self, observation): return [STARTED]

class Counting:
    '''Counts its episodes in a module's variable.'''
    def reset(self, seed):
        global seen
        seen += 1.0
    def act(self, observation): return [seen]

class Sharing:
    '''Counts its episodes in shared memory that was made on import.'''
    def reset(self, seed): shared[0] += 1
    def act(self, observation): return [float(shared[0])]

class Reading:
    '''Keeps a file open, as np.load does with an archive.'''
    weights = open(__file__, "rb")
    def reset(self, seed): pass
    def act(self, observation): return [float(os.pread(self.weights.fileno(), 6, 1) == b"import")]

class Dying:
    def reset(self, seed): pass
    def act(self, observation): os._exit(3)
"""


@pytest.fixture
def preloaded(tmp_path, each_level):
    """A policy that is imported once: it means the same at every level."""

    def policy(name, source=POLICY, preload=True):
        (tmp_path / "policy.py").write_text(source)
        return SandboxedPolicy(
            name=name,
            place=f"policy:{name}",
            folder=tmp_path,
            preload=preload,
            isolation=each_level,
        )

    yield policy
    close_sandboxes()


def action(policy):
    """Return the first action of a new episode."""
    with policy.agent() as agent:
        agent.reset(1)
        return agent.act(np.zeros(5)).tolist()[0]


def test_the_module_is_imported_once(preloaded):
    policy = preloaded("Started")
    assert action(policy) == action(policy)


def test_without_preload_it_is_imported_for_every_episode(preloaded):
    fresh = preloaded("Started", preload=False)
    assert action(fresh) != action(fresh)


def test_what_an_episode_does_to_the_module_dies_with_it(preloaded):
    policy = preloaded("Counting")
    assert [action(policy) for _ in range(3)] == [1.0, 1.0, 1.0]


def test_memory_shared_on_import_survives_which_is_why_there_is_an_audit(preloaded):
    policy = preloaded("Sharing")
    assert [action(policy) for _ in range(3)] == [1.0, 2.0, 3.0]


def test_a_file_opened_on_import_stays_open(preloaded):
    policy = preloaded("Reading")
    assert [action(policy) for _ in range(2)] == [1.0, 1.0]


def test_an_episode_that_ends_its_process_leaves_the_next_alone(preloaded):
    with pytest.raises(PolicyError):
        action(preloaded("Dying"))
    assert action(preloaded("Counting")) == 1.0


@pytest.mark.parametrize(
    ("source", "told"),
    [
        ("print('so far')\nraise ValueError('no weights')", "ValueError: no weights"),
        ("print('so far')\nimport os\nos._exit(4)", "exit code 4"),
        ("print('so far')\nraise SystemExit('bye')", "SystemExit: bye"),
        ("print('so far')", "no class 'Policy'"),
    ],
)
def test_a_module_that_cannot_be_imported_fails_every_episode_with_the_reason(
    preloaded, source, told
):
    policy = preloaded("Policy", source)
    for _ in range(2):
        with policy.agent() as agent:
            assert told in str(agent.failure)
            assert agent.printed == "so far\n"
            with pytest.raises(PolicyError):
                agent.reset(1)


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
    manifest = folder / "policy.toml"
    manifest.write_text(manifest.read_text().replace("preload = false", "preload = true"))
    done = subprocess.run(
        [sys.executable, "-W", "error", "-c", LEFT_OPEN, folder], capture_output=True, text=True
    )
    assert (done.returncode, done.stderr) == (0, "")
