"""A run of the blend policy on a few lifts, as a bundle in a folder."""

from pathlib import Path

import pytest
from colift.agents.loading.policy_spec import PolicySpec
from colift.benchmark.bundle import Bundle, read_bundle, results, write_bundle
from colift.benchmark.execution.runner import run_suite
from colift.benchmark.suites.suite import make_suite


@pytest.fixture(scope="session")
def bundle_folder(once) -> Path:
    def make(place: Path) -> None:
        run = run_suite(PolicySpec(text="blend"), make_suite("quick-v1"))
        write_bundle(place / "bundle", run, results(run, {}).plain())

    return once("replayed", make) / "bundle"


@pytest.fixture(scope="session")
def bundle(bundle_folder) -> Bundle:
    return read_bundle(bundle_folder)
