"""What an environment is made and reset with, and the refusal of what it cannot be."""

import numpy as np
import pytest
from colift.base.errors import InputError
from colift.benchmark.environment import RobotEnv, parallel_env


@pytest.mark.parametrize("make", [RobotEnv, parallel_env])
@pytest.mark.parametrize(
    ("setting", "value", "told"),
    [
        ("behaviour", ["smooth", "pause"], r"behaviour must be one name.*\['smooth', 'pause'\]"),
        ("behaviour", None, "behaviour must be one name, a string, got None"),
        ("subject", {"S1"}, "subject must be one name"),
        ("subject", "S9", "unknown subject 'S9'; known: S1"),
        ("latency", "0.1", "latency must be a number of seconds, got '0.1'"),
        ("control_period", True, "control_period must be a number of seconds, got True"),
        ("control_period", float("nan"), "control_period must be a multiple"),
        ("latency", float("inf"), "latency must be a multiple"),
    ],
)
def test_an_odd_setting_is_refused_in_words(make, setting, value, told):
    with pytest.raises(InputError, match=told):
        make(**{setting: value})


@pytest.mark.parametrize(
    ("partner", "told"),
    [
        ("human", "partner must be a robot here, got 'human': .*parallel_env"),
        ("", "partner must be one of 'iiwa', 'nao', 'human', 'live', got ''"),
        (None, "partner must be one name, a string, got None"),
        (["nao"], "partner must be one name, a string"),
    ],
)
def test_the_partner_of_the_gymnasium_view_is_a_robot(partner, told):
    with pytest.raises(InputError, match=told):
        RobotEnv(partner=partner)


@pytest.mark.parametrize("partner", ["nao", "iiwa"])
def test_the_gymnasium_view_has_any_robot(partner):
    env = RobotEnv(partner=partner)
    env.reset(seed=1)
    assert np.isfinite(env.step(np.array([0.01]))[0]).all()
    env.close()


def test_an_unknown_setting_is_named():
    with pytest.raises(InputError, match="no such setting: humans, speed; known: behaviour"):
        RobotEnv(speed=2, humans=3)


def test_a_step_before_the_first_reset_says_what_to_do():
    env = RobotEnv()
    with pytest.raises(RuntimeError, match=r"call reset\(\) first"):
        env.step(np.zeros(1))
    env.close()


@pytest.mark.parametrize("make", [RobotEnv, parallel_env])
def test_a_reset_changes_no_setting(make):
    env = make()
    with pytest.raises(InputError, match="reset cannot change subject"):
        env.reset(options={"subject": "S2"})
    env.reset(seed=1, options={})
    env.close()


def test_an_option_that_nobody_knows_is_refused_where_the_conformance_tests_give_none():
    env = RobotEnv()
    with pytest.raises(InputError, match="unknown option 'speed'"):
        env.reset(options={"speed": 2})
    env.close()
