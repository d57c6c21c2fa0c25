"""A policy is the same one on a machine that has nothing of it, or is not played there at all."""

import dataclasses
import os
import pickle
import subprocess
import sys
from pathlib import Path

import msgpack
import pytest
from colift.agents.loading.policy_spec import PolicySpec
from colift.agents.sandbox.host.levels import strongest
from colift.agents.sandbox.host.policy import SandboxedPolicy
from colift.agents.submissions.new import write_template
from colift.agents.submissions.submission import open_submission
from colift.base.errors import EvaluatorFault, InputError
from colift.benchmark.execution.packaging import packaged
from colift.benchmark.execution.runner import run_suite

from ...four import FOUR

SUITE = FOUR.with_seeds(0, 1)

MINE = """
import numpy as np
from pathlib import Path

class Mine:
    gain: float = 1.0
    def __init__(self, gain=1.0):
        self.gain = gain
    def reset(self, seed):
        self.last = 0.0
    def act(self, observation):
        return np.array([self.gain * (observation[0] - observation[3])])
"""

ELSEWHERE = """
import pickle, sys
from colift.benchmark.execution.runner import run_suite

if __name__ == "__main__":
    suite, policy = pickle.load(sys.stdin.buffer)
    run = run_suite(policy, suite)
    print(run.policy, run.policy_digest, run.isolation)
    for episode in run.episodes:
        print(episode.trace.digest(), episode.failure)
"""


@pytest.fixture
def file(tmp_path):
    path = tmp_path / "mine.py"
    path.write_text(MINE)
    return path


@pytest.fixture
def submission(tmp_path):
    write_template(tmp_path / "lifter")
    (tmp_path / "lifter" / "notes").mkdir()
    (tmp_path / "lifter" / "notes" / "weights.bin").write_bytes(os.urandom(100_000))
    return open_submission(tmp_path / "lifter")


def elsewhere(policy, home):
    """Return what a machine says that plays the policy, and has another home and nothing else."""
    done = subprocess.run(
        [sys.executable, "-c", ELSEWHERE],
        input=pickle.dumps((SUITE, policy)),
        capture_output=True,
        cwd=home,
        env={**os.environ, "XDG_CACHE_HOME": str(home)},
    )
    assert done.returncode == 0, done.stderr.decode()
    return done.stdout.decode().splitlines()


def here(spec):
    """Return what the other machine should say."""
    run = run_suite(spec, SUITE)
    first = f"{run.policy} {run.policy_digest} {run.isolation}"
    return [first, *(f"{each.trace.digest()} {each.failure}" for each in run.episodes)]


def test_a_policy_of_ours_is_found_over_there(tmp_path):
    spec = PolicySpec(text="extrapolate,steps=1")
    assert elsewhere(packaged(spec), tmp_path) == here(spec)
    assert packaged(spec).packed_files == b""


def test_a_file_travels_with_its_policy(file, tmp_path):
    spec = PolicySpec(text=f"{file}:Mine,gain=0.8")
    wanted, policy = here(spec), packaged(spec)
    file.unlink()
    assert elsewhere(policy, tmp_path) == wanted


@pytest.mark.slow
def test_a_submission_travels_whole_and_is_isolated_as_it_was(submission, tmp_path):
    spec = submission.sandboxed(None)
    wanted, policy = here(spec), packaged(spec)
    assert policy.spec.isolation == policy.isolation == spec.isolation == strongest()
    assert elsewhere(policy, tmp_path) == wanted
    weights = list(tmp_path.glob("colift/submissions/*/notes/weights.bin"))
    assert [each.stat().st_size for each in weights] == [100_000]


def test_a_trusted_submission_travels_too(submission, tmp_path):
    spec = submission.trusted()
    assert elsewhere(packaged(spec), tmp_path) == here(spec)


@pytest.mark.slow
def test_a_sandboxed_module_is_found_over_there(tmp_path):
    spec = SandboxedPolicy(
        name="copy", origin="colift.agents.policies.copy:Copy", source_digest="d"
    )
    assert elsewhere(packaged(spec), tmp_path) == here(spec)


def test_what_does_not_exist_is_not_packaged():
    with pytest.raises(InputError, match="nonesuch"):
        packaged(PolicySpec(text="nonesuch"))


def sandboxed_copy():
    return SandboxedPolicy(name="copy", origin="colift.agents.policies.copy:Copy")


@pytest.mark.parametrize("spec", [PolicySpec(text="copy"), sandboxed_copy()])
def test_another_policy_of_that_name_is_the_machines_fault(spec):
    other = dataclasses.replace(packaged(spec), installed_digest="0" * 16)
    with pytest.raises(EvaluatorFault, match="on a worker, must have 0000000000000000: install"):
        run_suite(other, SUITE)


def test_files_that_change_on_the_way_are_the_machines_fault(file):
    policy = packaged(PolicySpec(text=f"{file}:Mine"))
    ((name, content),) = msgpack.unpackb(policy.packed_files)
    files = msgpack.packb([(name, content.replace(b"1.0", b"1.1"))])
    changed = dataclasses.replace(policy, packed_files=files)
    with pytest.raises(EvaluatorFault, match="the files of policy Mine were changed in transit"):
        run_suite(changed, SUITE)


def test_a_machine_without_room_for_the_files_is_at_fault(file, tmp_path, monkeypatch):
    policy = packaged(PolicySpec(text=f"{file}:Mine,gain=0.7"))
    Path(tmp_path / "full").write_bytes(b"")
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "full"))
    with pytest.raises(EvaluatorFault, match="cannot write to"):
        run_suite(policy, SUITE)
