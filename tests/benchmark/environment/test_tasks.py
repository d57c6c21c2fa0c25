"""The environment of a task with senses, rewards and lifts of its own."""

import numpy as np
import pytest
from colift.base.errors import InputError
from colift.benchmark.environment import RobotEnv, parallel_env
from colift.benchmark.suites.catalogue import make_task
from colift.benchmark.tasks.intent.task import Intent
from gymnasium.utils.env_checker import check_env
from pettingzoo.test import parallel_api_test, parallel_seed_test


@pytest.mark.filterwarnings("ignore:We recommend agents to be named:UserWarning")
@pytest.mark.filterwarnings("ignore:Agents have different:UserWarning")
@pytest.mark.filterwarnings("ignore:Observations are different shapes:UserWarning")
@pytest.mark.parametrize("partner", ["nao", "human"])
def test_the_environment_of_intended_poses_passes_pettingzoos_tests(partner):
    made = parallel_env("pivot", partner=partner, task="intent")
    parallel_api_test(made, num_cycles=120)
    made.close()
    parallel_seed_test(lambda: parallel_env("pivot", partner=partner, task="intent"))


@pytest.mark.filterwarnings("ignore:.*we recommend.*:UserWarning")
def test_the_robots_side_of_it_passes_gymnasiums_test():
    robot = RobotEnv(behaviour="switching", task="intent")
    check_env(robot, skip_render_check=True)
    low, high = Intent().robot_bounds()
    assert np.array_equal(robot.observation_space.low, low)
    assert np.array_equal(robot.observation_space.high, high)
    robot.close()


def test_the_rewards_are_those_of_the_task():
    made = parallel_env("pivot", task="intent")
    observations, _ = made.reset(seed=3)
    human = made.scripted_human()
    for _ in range(20):
        actions = {"human": human.act(observations["human"]), "robot": np.zeros(1)}
        observations, rewards, *_ = made.step(actions)
    assert rewards == dict(zip(("human", "robot"), made.lift.task.rewards(made.lift), strict=True))
    assert rewards["robot"] == -abs(
        made.lift.world.robot_end[-1] - made.lift.due.far[made.lift.frame - 1]
    )
    made.close()


@pytest.mark.parametrize("task", ["level", "intent", "agree", "ball"])
def test_lifts_are_drawn_for_every_task(task):
    made = parallel_env(behaviour="any", subject="draw", task=task)
    drawn = {made.reset(seed=seed)[1]["robot"]["scenario"].partition("/")[0] for seed in range(30)}
    assert drawn == set(make_task(task).behaviours)
    made.close()


def test_an_unknown_task_and_a_reward_that_it_lacks_are_refused_by_name():
    with pytest.raises(InputError, match="unknown task 'level up'"):
        parallel_env(task="level up")
    with pytest.raises(InputError, match="task 'intent' has no reward 'score'"):
        parallel_env("pivot", task="intent", reward="score")
