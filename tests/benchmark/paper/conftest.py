"""A report on few lifts, made once."""

import dataclasses
import pickle

import pytest
from colift.benchmark.paper.evidence import Effort, collect_evidence, lift_count
from colift.benchmark.paper.report import make_report, write_report
from colift.benchmark.suites.suite import make_suite

EFFORT = Effort(
    pause=1,
    rest=1,
    jerky=1,
    forgetting=1,
    timing=1,
    periods=(0.05, 0.1),
    latencies=(0.05, 0.1),
    learning_trials=1,
)


@dataclasses.dataclass(frozen=True)
class Made:
    """What came of it."""

    evidence: object
    report: object
    folder: object
    counted: int
    expected: int


@pytest.fixture(scope="session")
def suite():
    whole = make_suite("paper-v1").with_seeds(1000, 1002)
    return dataclasses.replace(whole, scenarios=(whole.scenarios[0], whole.scenarios[2]))


@pytest.fixture(scope="session")
def made(suite, once):
    def make(place):
        counted = []
        evidence = collect_evidence(suite, EFFORT, progress=counted.append)
        write_report(make_report(evidence), place / "new" / "report")
        (place / "evidence").write_bytes(pickle.dumps((evidence, sum(counted))))

    place = once("paper", make)
    evidence, counted = pickle.loads((place / "evidence").read_bytes())
    folder = place / "new" / "report"
    return Made(evidence, make_report(evidence), folder, counted, lift_count(suite, EFFORT))
