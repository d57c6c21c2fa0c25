"""The tuning of hand-made policies: on whom, which ones, and what it gains."""

import pytest
from colift.base.errors import InputError
from colift.benchmark.admission.control import control_suite, first_people
from colift.benchmark.admission.tuning import training_people, tune, tunings
from colift.benchmark.suites.suite import make_suite


def people(suite):
    """Return the names of a suite's people."""
    return {each.subject.name for each in suite.scenarios}


def test_the_people_are_of_no_suite_and_others_judge():
    suite = make_suite("ball-v1")
    tuned, judging = training_people(suite, 0), training_people(suite, 12)
    assert len(people(tuned)) == len(people(judging)) == 12
    assert not people(tuned) & people(judging)
    assert not (people(tuned) | people(judging)) & people(suite)
    assert {each.behaviour for each in tuned.scenarios} == {e.behaviour for e in suite.scenarios}


def test_hand_made_policies_of_the_task_are_tuned():
    assert tunings("ball") == ("ball_admittance", "ball_calm", "ball_game", "ball_steady")
    assert tunings("ball", ["ball_calm"]) == ("ball_calm",)


@pytest.mark.parametrize(
    ("task", "names", "words"),
    [
        ("level", None, "'level' has no policies of its own with parameters to tune"),
        ("ball", ["ball_learned"], "'ball_learned' cannot be tuned; can be: ball_admittance"),
    ],
)
def test_what_cannot_be_tuned_is_refused(task, names, words):
    with pytest.raises(InputError, match=words):
        tunings(task, names)


@pytest.mark.slow
def test_a_tuned_policy_is_not_worse_with_other_people():
    found = tune("pose_wrist", make_suite("intent-v1"), people=2)
    assert found.after_mm <= found.before_mm
    assert bool(found.settings) is (found.after_mm < found.before_mm)


def test_the_first_people_are_those_of_the_control():
    suite = control_suite(3)
    assert len(people(suite)) == 3
    assert people(suite) <= people(make_suite("standard-v1"))
    assert first_people(suite, 5) is suite
    with pytest.raises(InputError, match="3 people or more, got 2"):
        first_people(suite, 2)
