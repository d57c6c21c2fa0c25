"""The suite that a submission is checked with before a board plays it."""

import pytest
from colift.benchmark.suites.suite import make_suite
from colift.benchmark.verification.checking import checked_with


@pytest.mark.parametrize("name", ["standard-v1", "paper-v1", "quick-v1"])
def test_a_policy_of_a_level_table_is_checked_with_few_lifts(name):
    assert checked_with(make_suite(name)).name == "quick-v1"


@pytest.mark.parametrize("name", ["intent-v1", "agree-v1", "ball-v1"])
def test_a_policy_of_another_task_is_checked_with_that_task(name):
    assert checked_with(make_suite(name)).name == name
