"""A policy's run is the same to the bit wherever the policy is."""

import numpy as np
import pytest
from colift.agents.loading.policy_spec import PolicySpec
from colift.agents.sandbox.host.policy import SandboxedPolicy, close_sandboxes
from colift.agents.submissions.submission import read_submission
from colift.benchmark.execution.pool import local_pool
from colift.benchmark.execution.runner import run_suite

from ...four import FOUR

MANIFEST = """
name = "mixed"
authors = ["Nobody"]
description = "Uses its seed, its own file and linear algebra."
licence = "MIT"
trained_on = "nothing"
entry_point = "policy:Policy"
"""

POLICY = """
import numpy as np

class Policy:
    def __init__(self):
        self.gains = np.linalg.qr(np.vander(np.linspace(0.1, 1.0, 5)))[0]

    def reset(self, seed):
        self.rng = np.random.default_rng(seed)
        self.estimate = np.zeros(5)

    def act(self, observation):
        self.estimate = 0.5 * self.estimate + self.gains @ (self.gains.T @ observation)
        noise = self.rng.normal(0.0, 1e-3)
        return [0.3 * (observation[0] - observation[2]) + 0.01 * np.sin(self.estimate[1]) + noise]

    def internals(self):
        return {"estimate": self.estimate[0]}
"""

SUITE = FOUR.with_seeds(0, 1)


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    folder = tmp_path_factory.mktemp("submission")
    (folder / "policy.toml").write_text(MANIFEST)
    (folder / "policy.py").write_text(POLICY)
    return folder


@pytest.fixture(scope="module", autouse=True)
def _no_sandbox_left():
    yield
    close_sandboxes()


def bits(run):
    """Return all of a run that must not depend on where it was."""
    assert run.complete
    assert [episode.failure for episode in run.episodes] == [None] * SUITE.size
    return [
        (
            episode.behaviour,
            episode.seed,
            episode.scores,
            episode.trace.action.tobytes(),
            episode.trace.human_action.tobytes(),
            episode.trace.state.tobytes(),
            episode.trace.internals["estimate"].tobytes(),
        )
        for episode in run.episodes
    ]


@pytest.fixture(scope="module")
def in_process(folder):
    return bits(run_suite(read_submission(folder).trusted(), SUITE))


def test_the_policy_uses_what_could_differ(folder, in_process):
    actions = np.frombuffer(in_process[0][3])
    assert len(np.unique(actions)) == len(actions)
    assert bits(run_suite(PolicySpec(text=f"{folder}/policy.py:Policy"), SUITE)) == in_process


@pytest.fixture(scope="module")
def two_workers():
    with local_pool(2) as pool:
        yield pool


@pytest.mark.slow
@pytest.mark.parametrize("jobs", [1, 2])
@pytest.mark.parametrize("form", ["folder", "file"])
def test_a_run_is_bit_identical_in_every_sandbox(
    folder, in_process, two_workers, each_level, form, jobs
):
    policy = read_submission(folder).sandboxed(each_level)
    if form == "file":
        policy = SandboxedPolicy(
            name="mixed", origin=f"{folder}/policy.py:Policy", isolation=each_level
        )
    run = run_suite(policy, SUITE, executor=two_workers if jobs == 2 else None)
    assert run.isolation == each_level
    assert bits(run) == in_process
