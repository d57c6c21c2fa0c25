"""The training view: drawn lifts, the reward of the score, wrappers, vectors of environments."""

import copy

import gymnasium
import numpy as np
import pytest
from colift.agents.policies.copy import Copy
from colift.agents.policies.extrapolate import Extrapolate
from colift.base.errors import InputError
from colift.benchmark.environment import (
    History,
    HoldingPace,
    RobotEnv,
    Scaled,
    env,
    parallel_env,
    training_env,
    training_view,
)
from colift.benchmark.environment.drawing import TRAINING_SEEDS
from colift.benchmark.episode.lift import Lift
from colift.benchmark.episode.loop import run_episode
from colift.benchmark.episode.metrics import rmse_mm
from colift.benchmark.suites.catalogue import make_scenario
from colift.benchmark.tasks.level.task import BEHAVIOURS
from colift.benchmark.world.interface import since_reset
from gymnasium.utils.env_checker import check_env
from pettingzoo.test import api_test, parallel_api_test, parallel_seed_test

DRAWN = {"behaviour": "any", "subject": "draw", "reward": "score"}


def episode(made, policy, seed):
    """Return the rewards of an episode in which a policy has the robot's seat."""
    policy.reset(0)
    observation, _ = made.reset(seed=seed)
    rewards, ended = [], False
    while not ended:
        observation, reward, terminated, truncated, _ = made.step(policy.act(observation))
        rewards.append(reward)
        ended = terminated or truncated
    return rewards


class Still:
    def reset(self, seed):
        pass

    def act(self, observation):
        return np.zeros(1)


@pytest.mark.parametrize("policy", [Copy, Still])
def test_the_sum_of_the_score_s_rewards_is_the_rmse(policy):
    made = RobotEnv(behaviour="pause", subject="S2", reward="score")
    rewards = episode(made, policy(), 3)
    lift = Lift(make_scenario("pause", "S2"))
    played = run_episode(lift, policy(), 3)
    steps = lift.horizon / lift.frames_per_step
    rmse = 10 * np.sqrt(-sum(rewards) / steps)
    assert rmse == pytest.approx(played.scores["rmse_mm"], rel=1e-9)
    assert len(rewards) == steps
    lift.close()
    made.close()


def thrown(reward):
    """Return an environment whose human has thrown the table up, and the rewards of each step."""
    made = parallel_env("pause", "S2", reward=reward)
    made.reset(seed=3)
    given = []
    while made.agents:
        _, rewards, dropped, *_ = made.step({"human": np.full(10, 0.5), "robot": -0.04})
        given.append(rewards)
    assert dropped["robot"]
    return made, given


def test_a_drop_pays_as_the_score_does():
    made, given = thrown("score")
    lift = made.lift
    ends = since_reset(lift.world.human_end), since_reset(lift.world.robot_end)
    rmse = rmse_mm(*ends, horizon=lift.horizon)
    steps = lift.horizon / lift.frames_per_step
    assert len(given) < steps / 2
    assert 10 * np.sqrt(-sum(each["robot"] for each in given) / steps) == pytest.approx(rmse)
    made.close()


def test_dropping_never_earns():
    for reward, earns in (("task", True), ("score", False)):
        made, given = thrown(reward)
        made.close()
        alone = RobotEnv(behaviour="pause", subject="S2", reward=reward)
        lifted = sum(episode(alone, Still(), 3))
        assert (sum(each["robot"] for each in given) > lifted) == earns
        alone.close()


def test_the_human_pays_for_its_own_target_and_for_a_drop():
    made, given = thrown("score")
    lift, size = made.lift, made.lift.frames_per_step
    target = lift.target[: lift.frame].reshape(-1, size)
    misses = (since_reset(lift.world.human_end).reshape(-1, size) - target) ** 2
    wanted = -1e4 * misses.mean(axis=1)
    wanted[-1] -= (lift.horizon - lift.frame) / size * 25.0**2
    np.testing.assert_allclose([each["human"] - each["robot"] for each in given], wanted)
    made.close()


def test_drawn_lifts_follow_from_the_reset_s_seed_and_are_for_training_only():
    made = RobotEnv(**DRAWN)
    seen = []
    for seed in range(40):
        observation, info = made.reset(seed=seed)
        behaviour, person = info["scenario"].split("/")
        assert info["seed"] in TRAINING_SEEDS
        assert int(person.removeprefix("draw-")) in TRAINING_SEEDS
        seen.append((behaviour, person, info["seed"], observation.tobytes()))
    assert {behaviour for behaviour, *_ in seen} == set(BEHAVIOURS)
    assert len({person for _, person, *_ in seen}) == len({lift for *_, lift, _ in seen}) == 40
    again, info = made.reset(seed=7)
    assert (info["scenario"], info["seed"], again.tobytes()) == (
        "/".join(seen[7][:2]),
        *seen[7][2:],
    )
    assert made.reset()[1] != made.reset()[1]
    made.close()


@pytest.mark.parametrize("partner", ["nao", "human"])
def test_a_person_who_takes_over_a_world_lifts_as_in_a_new_one_bit_for_bit(partner):
    made = parallel_env("any", "draw", partner=partner)
    for seed in (1, 2, 3):
        observations, infos = made.reset(seed=seed)
        fresh = Lift(make_scenario(*infos["robot"]["scenario"].split("/"), partner=partner))
        fresh.reset(infos["robot"]["seed"])
        human, other = made.scripted_human(), fresh.scripted_human()
        while made.agents:
            action = np.full(made.action_space("robot").shape, 0.01)
            fresh.step(other.act(fresh.human_observation()), action)
            actions = {"human": human.act(observations["human"]), "robot": action}
            observations, *_ = made.step(actions)
            assert made.lift.world.state() == fresh.world.state()
        assert fresh.done
        fresh.close()
    made.close()


def test_one_of_both_can_be_drawn():
    person = parallel_env("jerky", "draw")
    names = {person.reset(seed=seed)[1]["robot"]["scenario"] for seed in range(5)}
    assert len(names) == 5
    assert all(name.startswith("jerky/draw-") for name in names)
    behaviour = parallel_env("any", "S3")
    names = {behaviour.reset(seed=seed)[1]["human"]["scenario"] for seed in range(20)}
    assert names == {f"{each}/S3" for each in BEHAVIOURS}
    person.close()
    behaviour.close()


def test_a_copy_draws_the_same_lifts():
    made = RobotEnv(**DRAWN)
    other = copy.deepcopy(made)
    assert episode(made, Copy(), 5) == episode(other, Copy(), 5)
    made.close()
    other.close()


@pytest.mark.filterwarnings("ignore:We recommend agents to be named:UserWarning")
@pytest.mark.filterwarnings("ignore:Agents have different:UserWarning")
@pytest.mark.filterwarnings("ignore:Observations are different shapes:UserWarning")
@pytest.mark.parametrize("partner", ["nao", "human"])
def test_pettingzoo_conforms_with_both_seats(partner):
    made = parallel_env(**DRAWN, partner=partner)
    parallel_api_test(made, num_cycles=120)
    made.close()
    parallel_seed_test(lambda: parallel_env(**DRAWN, partner=partner), num_cycles=40)
    made = env(**DRAWN, partner=partner)
    api_test(made, num_cycles=60)
    made.close()


@pytest.mark.filterwarnings("ignore:.*is different from the unwrapped version:UserWarning")
@pytest.mark.parametrize(
    "make",
    [
        lambda: RobotEnv(**DRAWN),
        lambda: History(RobotEnv(**DRAWN), steps=3),
        lambda: Scaled(RobotEnv(**DRAWN)),
        training_env,
        lambda: training_env("pause", "S2", reward="task", pace=False, steps=1),
    ],
)
def test_gymnasium_conforms_with_every_wrapper(make):
    made = make()
    check_env(made, skip_render_check=True)
    made.close()


def test_history_shows_heights_relative_to_the_human_and_the_past():
    made = History(RobotEnv(behaviour="smooth", subject="S1"), steps=4)
    plain = RobotEnv(behaviour="smooth", subject="S1")
    seen = [plain.reset(seed=2)[0]]
    first, _ = made.reset(seed=2)
    np.testing.assert_array_equal(first[4:], 0.0)
    for _ in range(15):
        seen.append(plain.step(np.array([0.01]))[0])
        last, *_ = made.step(np.array([0.01]))
    heights, commands = np.array(seen)[:, 0], np.array(seen)[:, 3]
    robot_end, hand = seen[-1][1:3]
    now = [heights[-1], commands[-1] - heights[-1], hand - commands[-1], robot_end - heights[-1]]
    np.testing.assert_allclose(last[:4], now)
    np.testing.assert_allclose(last[4:7], np.diff(commands)[::-1][:3])
    np.testing.assert_allclose(last[7:], np.diff(heights)[::-1][:4])
    made.close()
    plain.close()


def test_no_correction_extrapolates():
    made = training_env("pause", "S2")
    plain = RobotEnv(behaviour="pause", subject="S2", reward="score")
    rewards = episode(plain, Extrapolate(), 3)
    np.testing.assert_allclose(episode(made, Still(), 3), rewards)
    made.close()
    plain.close()


def test_a_scaled_action_of_one_is_the_hand_s_speed():
    made = Scaled(RobotEnv())
    made.reset(seed=0)
    observation, *_ = made.step(np.array([3.0], np.float32))
    assert observation.dtype == np.float32
    assert observation[3] == pytest.approx(0.04 / 0.1)
    assert observation[4] == pytest.approx(0.1 / 10)
    made.close()


@pytest.mark.parametrize("mode", ["sync", "async"])
def test_gymnasium_makes_vectors_of_it(mode):
    alone = training_env()
    wanted = [alone.reset(seed=seed)[0] for seed in (5, 6, 7, 8)]
    vector = gymnasium.make_vec(
        "colift/Lift-v0", num_envs=4, vectorization_mode=mode, wrappers=[training_view], **DRAWN
    )
    observations, infos = vector.reset(seed=5)
    np.testing.assert_array_equal(observations, wanted)
    assert len(set(infos["scenario"])) == 4
    for _ in range(3):
        observations, rewards, *_ = vector.step(np.zeros((4, 1), np.float32))
    assert observations.shape == (4, 27)
    assert (rewards < 0).all()
    vector.close()
    alone.close()


@pytest.mark.parametrize("make", [RobotEnv, parallel_env])
def test_an_unknown_reward_is_refused(make):
    with pytest.raises(InputError, match="reward must be 'task' or 'score', got 'speed'"):
        make(reward="speed")


def test_wrong_wrapping_is_refused_in_words():
    plain = RobotEnv()
    with pytest.raises(InputError, match="steps must be a whole number of at least 1, got 0"):
        History(plain, steps=0)
    with pytest.raises(InputError, match=r"robot's five numbers, got observations \(27,\)"):
        History(History(plain))
    with pytest.raises(InputError, match="wrap the environment in History first"):
        HoldingPace(plain)
    plain.close()
