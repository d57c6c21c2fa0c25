"""Wrong use of the environments: each mistake is refused where it is made, and named."""

import inspect

import numpy as np
import pytest
from colift import colift_v0
from colift.benchmark.environment import RobotEnv, env, parallel_env

LEVEL = {"human": np.zeros(10), "robot": np.zeros(1)}


@pytest.mark.parametrize("make", [parallel_env, RobotEnv])
def test_a_closed_environment_says_so(make):
    made = make(behaviour="pause")
    made.reset(seed=1)
    made.close()
    made.close()
    with pytest.raises(RuntimeError, match="the environment is closed: make a new one"):
        made.reset(seed=1)
    with pytest.raises(RuntimeError, match="the environment is closed: make a new one"):
        made.step(LEVEL if make is parallel_env else 0.0)


def test_there_is_no_scripted_human_before_an_episode():
    made = parallel_env()
    with pytest.raises(RuntimeError, match="no episode has begun: call reset"):
        made.scripted_human()
    made.close()


def test_an_action_of_nobody_is_refused():
    made = parallel_env()
    made.reset(seed=1)
    with pytest.raises(ValueError, match=r"actions must be of human and robot, got \['nao'\]"):
        made.step({**LEVEL, "nao": 0.0})
    made.close()


def test_in_turns_an_action_is_refused_in_its_own_turn():
    made = env("pause", "S3")
    made.reset(seed=1)
    assert made.agent_selection == "human"
    with pytest.raises(ValueError, match=r"human's action must be 10 numbers, got 0\.0"):
        made.step(0.0)
    made.step(made.scripted_human().act(made.observe("human")))
    assert made.agent_selection == "robot"
    with pytest.raises(ValueError, match="robot's action must be finite"):
        made.step(np.nan)
    made.step(0.0)
    assert made.agent_selection == "human"
    made.close()


def test_all_constructors_show_the_same_parameters():
    wanted = list(inspect.signature(parallel_env).parameters)
    for made in (env, colift_v0.env, colift_v0.raw_env):
        assert list(inspect.signature(made).parameters) == wanted
    assert env("pause", subject="S3").unwrapped.lift.scenario.name == "pause/S3"
