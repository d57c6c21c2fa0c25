"""The environment of a task with senses, rewards and lifts of its own."""

from dataclasses import replace

import numpy as np
import pytest
from colift.agents.loading.policy_spec import PolicySpec
from colift.base.errors import InputError
from colift.benchmark.environment import ParallelLift, RobotEnv, parallel_env
from colift.benchmark.execution.playing import play
from colift.benchmark.suites.catalogue import make_scenario, make_task
from colift.benchmark.tasks.intent.task import Intent
from colift.benchmark.tasks.level.task import Level
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
    odd = replace(make_scenario("smooth", "S2"), task=ScoredOtherwise())
    with pytest.raises(InputError, match="task 'otherwise' has no reward 'score'"):
        ParallelLift(odd, reward="score")


class ScoredOtherwise(Level):
    name = "otherwise"

    def score(self, lift, trace, *, failed):
        return super().score(lift, trace, failed=failed)


LIFTS = [
    ("intent", "pivot", "pose_wrist"),
    ("intent", "switching", "hold"),
    ("agree", "abreast", "agree_follower"),
    ("agree", "own_hurdle", "hold"),
    ("agree", "no_hurdle", "agree_follower"),
    ("ball", "ball_pause", "ball_steady"),
    ("ball", "ball_smooth", "copy"),
]


@pytest.mark.parametrize(("task", "behaviour", "name"), LIFTS)
def test_rewards_of_the_score_add_up_to_it_in_tasks_that_are_stated_by_rules(task, behaviour, name):
    made = RobotEnv(behaviour=behaviour, subject="S2", task=task, reward="score")
    policy, rewards, ended = PolicySpec(text=name).make(), [], False
    policy.reset(0)
    seen, _ = made.reset(seed=3)
    while not ended:
        seen, reward, terminated, truncated, _ = made.step(policy.act(seen))
        rewards.append(reward)
        ended = terminated or truncated
    scenario = make_scenario(behaviour, "S2", task=task)
    (played,) = play(PolicySpec(text=name), scenario, (3,))
    lift = made._env.lift
    steps = lift.horizon / lift.frames_per_step
    rmse_mm = 10 * np.sqrt(-sum(rewards) / steps)
    assert rmse_mm == pytest.approx(played.scores["rmse_mm"], rel=1e-9)
    assert min(map(abs, rewards)) < max(map(abs, rewards))  # It is not all in one step.
    assert sum(reward != 0.0 for reward in rewards) > len(rewards) / 10
    made.close()
