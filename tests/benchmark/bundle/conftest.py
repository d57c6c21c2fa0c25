"""Runs and bundles to look at."""

import pytest
from colift.agents.policies.copy import Copy
from colift.agents.spec import InProcess
from colift.base.errors import PolicyError
from colift.benchmark.bundle import results, write_bundle
from colift.benchmark.execution.runner import run_suite

from ...four import FOUR


class Hostile(Copy):
    """Fails in some episodes, and says what it can to break the reader of a bundle."""

    printed = "line one\nline two\x1b[2J\ud800 \N{PILE OF POO}"

    def reset(self, seed):
        super().reset(seed)
        self.step = 0

    def act(self, observation):
        self.step += 1
        if self.step > 30 and observation[0] < 0.02:
            raise PolicyError(
                'no\r\n"more", \x00\x1b[31m\ud800 \u202e \N{PILE OF POO}' + "x" * 5000
            )
        return super().act(observation)

    def internals(self):
        return {"guess": 1.0, "../../x": 2.0, "a\0b": 3.0, "\ud800": 4.0, "": 5.0}


class HostileSpec(InProcess):
    """Where the hostile policy is."""

    name = "hostile"

    def check(self):
        pass

    def digest(self):
        return "0" * 16

    def make(self):
        return Hostile()


@pytest.fixture(scope="session")
def hostile_run():
    return run_suite(HostileSpec(), FOUR.with_seeds(3, 5))


@pytest.fixture
def hostile(hostile_run, tmp_path):
    folder = tmp_path / "hostile"
    write_bundle(folder, hostile_run, results(hostile_run, {}).plain())
    return folder
