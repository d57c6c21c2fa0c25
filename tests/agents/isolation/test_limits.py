"""What an episode may use up."""

import json
import math
from dataclasses import fields

import pytest
from colift.agents.errors import InputError
from colift.agents.isolation.limits import LIMITS, Limits


@pytest.mark.parametrize("name", [each.name for each in fields(Limits)])
@pytest.mark.parametrize("value", [0, -1, math.inf, math.nan])
def test_a_limit_is_a_positive_number(name, value):
    with pytest.raises(InputError, match=f"limit {name} must be a positive number, got {value}"):
        Limits(**{name: value})


def test_another_process_gets_equal_limits():
    assert Limits(**json.loads(json.dumps(LIMITS.plain()))) == LIMITS


def test_an_episode_has_time_for_import_reset_and_steps():
    assert LIMITS.episode_seconds > 2 * LIMITS.start_seconds + LIMITS.step_seconds
