"""A report on few lifts, made once."""

import dataclasses

import pytest
from colift.benchmark.paper.evidence import Effort, amount, gather
from colift.benchmark.paper.report import make_report, write_report
from colift.benchmark.suite import make_suite

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
def made(suite, tmp_path_factory):
    counted = []
    evidence = gather(suite, EFFORT, progress=counted.append)
    report = make_report(evidence)
    folder = tmp_path_factory.mktemp("paper") / "new" / "report"
    write_report(report, folder)
    return Made(evidence, report, folder, sum(counted), amount(suite, EFFORT))
