"""Bundles of true runs, and copies of them to forge."""

import shutil

import pytest
from colift.agents.loading.policy_spec import PolicySpec
from colift.agents.policies.copy import Copy
from colift.agents.spec import InProcess
from colift.base.errors import PolicyError
from colift.benchmark.bundle import results, write_bundle
from colift.benchmark.execution.runner import run_suite

from .forging import SUITE


class Giving(Copy):
    """Copies, and gives up in some episodes at step 20."""

    def reset(self, seed):
        super().reset(seed)
        self.steps = 0

    def act(self, observation):
        self.steps += 1
        if self.steps > 20 and observation[0] > 0.03:
            raise PolicyError("too high for me")
        return super().act(observation)

    def internals(self):
        return {"prediction": 0.5}


class GivingSpec(InProcess):
    name = "giving"

    def check(self):
        pass

    def digest(self):
        return "0" * 16

    def make(self):
        return Giving()


@pytest.fixture(scope="session")
def made(tmp_path_factory):
    """Bundles of true runs, by name."""
    root = tmp_path_factory.mktemp("bundles")
    for name, spec in (("copy", PolicySpec(text="copy")), ("giving", GivingSpec())):
        run = run_suite(spec, SUITE)
        write_bundle(root / name, run, results(run, {}).plain())
    return root


@pytest.fixture
def bundle(made, tmp_path):
    return shutil.copytree(made / "copy", tmp_path / "bundle")


@pytest.fixture
def giving(made, tmp_path):
    return shutil.copytree(made / "giving", tmp_path / "giving")
