"""A run of the blend policy on a few lifts, as a bundle in a folder."""

from pathlib import Path

import pytest
from colift.agents.loading.loading import PolicySpec
from colift.benchmark.bundle import Bundle, read_bundle, results, write_bundle
from colift.benchmark.execution.runner import run_suite
from colift.benchmark.suites.suite import make_suite


@pytest.fixture(scope="session")
def bundle_folder(tmp_path_factory) -> Path:
    run = run_suite(PolicySpec(text="blend"), make_suite("quick-v1"))
    folder = tmp_path_factory.mktemp("entry") / "bundle"
    write_bundle(folder, run, results(run, {}).plain())
    return folder


@pytest.fixture(scope="session")
def bundle(bundle_folder) -> Bundle:
    return read_bundle(bundle_folder)
