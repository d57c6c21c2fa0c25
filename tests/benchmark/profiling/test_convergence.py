"""The convergence study: the step of a task is as near to a fine one as it says."""

import dataclasses
from statistics import fmean

import pytest
from colift.benchmark.profiling.convergence import PAIR, physics_errors
from colift.benchmark.suites.suite import make_suite
from colift.benchmark.tasks.touch import FINER
from colift.benchmark.world.physics import PHYSICS, Physics


@pytest.mark.slow
@pytest.mark.parametrize("policy", ["ball_calm", PAIR])
def test_the_step_of_the_ball_is_finer_than_the_usual_one(policy):
    suite = make_suite("ball-v1")
    errors = []
    for scenario in suite.scenarios[:11:5]:
        one = dataclasses.replace(suite, scenarios=(scenario,), seeds=(100_000,))
        fine, usual = physics_errors(one, policy, Physics(step=0.001), FINER, PHYSICS)
        assert fine.height_error_mm < 0.5 * usual.height_error_mm
        assert fine.worst_error < usual.worst_error
        errors.append(fine.worst_error)
    assert fmean(errors) < 0.01


@pytest.mark.slow
def test_another_physics_is_what_is_played():
    suite = make_suite("intent-v1")
    one = dataclasses.replace(suite, scenarios=suite.scenarios[:1])
    (same,) = physics_errors(one, "touch_level", PHYSICS, PHYSICS)
    (other,) = physics_errors(one, "touch_level", PHYSICS, Physics(step=0.005))
    assert same.height_error_mm == 0.0
    assert other.height_error_mm > 0.0
