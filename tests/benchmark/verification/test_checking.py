"""The pre-submission checks on suites other than that of the score."""

import dataclasses

import pytest
from colift.agents.loading.policy_spec import PolicySpec
from colift.benchmark.execution.runner import run_suite
from colift.benchmark.suites.suite import make_suite
from colift.benchmark.verification.checking import check_part, presubmission_checks


def test_of_a_large_suite_two_lifts_of_each_behaviour_are_checked_with_different_people():
    part = check_part(make_suite("intent-v1"))
    assert part.size == 8
    assert len({scenario.behaviour for scenario in part.scenarios}) == 4
    assert len({scenario.subject.name for scenario in part.scenarios}) == 8
    quick = make_suite("quick-v1")
    assert check_part(quick) is quick


@pytest.mark.slow
def test_a_policy_is_checked_on_the_task_of_the_suite_that_it_is_for():
    spec = PolicySpec(text="pose_wrist")
    whole = make_suite("intent-v1")
    two = dataclasses.replace(whole, scenarios=whole.scenarios[:2], seeds=whole.seeds[:1])
    done = list(presubmission_checks(spec, spec, run_suite, two))
    assert all(check.ok for check in done)
    (score,) = [check for check in done if check.name == "score"]
    assert score.message.startswith("intent-v1, 2 lifts: RMSE")
