"""A bundle with whole lifts, one that the policy gave up and one without a step; and a drop."""

from contextlib import closing

import numpy as np
import pytest
from colift.agents.policies.copy import Copy
from colift.agents.spec import InProcess
from colift.base.errors import PolicyError
from colift.benchmark.bundle import read_bundle, results, write_bundle
from colift.benchmark.execution.runner import run_suite
from colift.benchmark.export.observing import ObservedLift, spaces
from colift.benchmark.export.provenance import Provenance, of_scenario
from colift.benchmark.suites.catalogue import make_scenario
from colift.benchmark.suites.suite import Suite

LIFTS = ("smooth/S1", "pause/S2", "jerky/S3", "changing_goal/S5")
SUITE = Suite(
    name="four",
    scenarios=tuple(make_scenario(*name.split("/")) for name in LIFTS),
    seeds=(41,),
)


class Uneven(Copy):
    """Copies, gives up, does not begin, or always goes up, lift by lift."""

    turn = 0

    def reset(self, seed):
        self.steps, self.kind = 0, Uneven.turn % 4
        Uneven.turn += 1
        if self.kind == 2:
            raise PolicyError("not today")

    def act(self, observation):
        self.steps += 1
        if self.kind == 1 and self.steps > 20:
            raise PolicyError("too tired")
        if self.kind == 3 and self.steps > 5:
            return np.array([0.04])
        return super().act(observation)


class UnevenSpec(InProcess):
    name = "uneven"

    def check(self):
        Uneven.turn = 0

    def digest(self):
        return "0" * 16

    def make(self):
        return Uneven()


@pytest.fixture(scope="session")
def run():
    return run_suite(UnevenSpec(), SUITE)


@pytest.fixture(scope="session")
def folder(run, tmp_path_factory):
    made = tmp_path_factory.mktemp("exported") / "bundle"
    write_bundle(made, run, results(run, {}).plain())
    return made


@pytest.fixture(scope="session")
def bundle(folder):
    return read_bundle(folder)


@pytest.fixture
def provenance():
    """Return what makes the origin of a set."""

    def made(view="robot", **changes):
        values = {
            "name": "four-uneven",
            "source": "colift export bundle",
            "policy": "uneven",
            "policy_digest": "0" * 16,
            "suite": SUITE.name,
            "suite_digest": SUITE.digest,
            "view": view,
            "converted": False,
            **of_scenario(SUITE.scenarios[0]),
        }
        return Provenance(**{**values, **changes})

    return made


@pytest.fixture(scope="session")
def dropped():
    """Return a lift in which the ends go apart until the table slides out of the hands."""
    with closing(ObservedLift(SUITE.scenarios[0], both=True)) as lift:
        lift.reset(41)
        while not lift.done:
            lift.step(np.full(10, 0.5), np.array([-0.04]))
        return lift.exported("apart", lift.dropped, b"")


@pytest.fixture(scope="session")
def boxes():
    return spaces(SUITE.scenarios[0])
