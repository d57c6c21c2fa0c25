"""A run, and its inspection."""

import pytest
from colift.agents.loading.policy_spec import PolicySpec
from colift.benchmark.bundle import results
from colift.benchmark.execution.runner import run_suite
from colift.benchmark.inspection.inspection import inspect_run
from colift.benchmark.results.baselines import play_baselines

from ...four import FOUR

SUITE = FOUR.with_seeds(3, 5)


@pytest.fixture(scope="session")
def baselines():
    return play_baselines(SUITE)


@pytest.fixture(scope="session")
def run():
    return run_suite(PolicySpec(text="copy"), SUITE)


@pytest.fixture(scope="session")
def found(run, baselines):
    return inspect_run(run, results(run, baselines))
