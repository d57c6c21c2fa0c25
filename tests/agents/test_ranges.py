"""Ranges of parameters, as users meet them."""

import pytest
from colift.agents.loading.policy_spec import PolicySpec
from colift.base.errors import InputError


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("agree_game,belief.along=1.28", "along must be a number from 0 to 1, got 1.28"),
        ("agree_game,apart=-0.1", "apart must be a number from 0 to 1, got -0.1"),
        ("agree_follower,needed=0", "needed must be a positive number, got 0.0"),
        ("ball_calm,steepest=-1", "steepest must be a number of at least 0, got -1.0"),
        ("ball_calm,steepest=inf", "steepest must be a number of at least 0, got inf"),
        ("pose_bayes,switch=2", "switch must be a number from 0 to 1, got 2.0"),
    ],
)
def test_a_value_outside_its_range_is_refused(text, words):
    with pytest.raises(InputError, match=words):
        PolicySpec(text=text).check()


@pytest.mark.parametrize("text", ["agree_game,belief.along=1", "ball_calm,calming=0"])
def test_the_ends_of_a_range_belong_to_it(text):
    PolicySpec(text=text).check()
