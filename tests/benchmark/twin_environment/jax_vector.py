"""The vector environment on the twin: the engine's lifts, and rewards that add up."""

import colift  # noqa: F401 - registers the environment
import gymnasium
import numpy as np
import pytest
from colift.agents.policies.extrapolate import Extrapolate
from colift.base.errors import InputError
from colift.benchmark.environment.drawing import make_drawing
from colift.benchmark.episode.lift import Lift
from colift.benchmark.episode.loop import run_episode
from colift.benchmark.episode.seeding import derive_seed
from colift.benchmark.twin_environment.vector import TwinVectorEnv


def make(**settings):
    return gymnasium.make_vec("colift/Lift-twin-v0", **settings)


def test_a_lift_is_that_of_the_engine_and_its_rewards_are_the_score():
    env = make(num_envs=2, lifts=1)
    view, _ = env.reset(seed=4)
    robots = [Extrapolate() for _ in range(2)]
    for robot in robots:
        robot.reset(0)
    rewards, steps, ended = np.zeros(2), 0, np.zeros(2, bool)
    while not ended.any():
        actions = [robot.act(seen) for robot, seen in zip(robots, view, strict=True)]
        view, reward, terminated, ended, _ = env.step(np.array(actions, np.float32))
        rewards, steps = rewards + reward, steps + 1
        assert not terminated.any()
    assert rewards[0] == rewards[1]

    seed = derive_seed(int(np.random.default_rng(4).integers(2**62)), "lift 0")
    scenario, seed = make_drawing("any", "draw", "nao", 0.1, 0.1).lift(seed)
    lift = Lift(scenario)
    episode = run_episode(lift, Extrapolate(), seed)
    lift.close()
    assert steps == len(episode.trace.action)
    rmse_mm = 10 * np.sqrt(-rewards[0] / steps)
    assert rmse_mm == pytest.approx(episode.scores["rmse_mm"], rel=0.005)


def test_a_lift_that_has_ended_begins_anew():
    env = make(num_envs=3, lifts=2)
    env.reset(seed=1)
    still = np.zeros((3, 1), np.float32)
    while True:
        view, _, terminated, truncated, _ = env.step(still)
        if (terminated | truncated).any():
            break
    over = terminated | truncated
    view, reward, terminated, truncated, _ = env.step(still)
    assert (view[over, 4] == 0).all()
    assert (reward[over] == 0).all()
    assert not (terminated | truncated)[over].any()
    assert env.observation_space.contains(view.astype(np.float32))


def test_lifts_of_one_plan_differ_by_their_noise_alone():
    env = make(num_envs=20, lifts=20, plans=1)
    view, _ = env.reset(seed=3)
    assert len(np.unique(view[:, 0])) > 1
    over, steps = np.zeros(20, bool), []
    for step in range(200):
        _, _, _, ended, _ = env.step(np.zeros((20, 1), np.float32))
        steps += [step] * int((ended & ~over).sum())
        over |= ended
        if over.all():
            break
    assert len(steps) == 20
    assert len(set(steps)) == 1


def test_dropping_never_earns():
    env = make(num_envs=2, lifts=1)
    env.reset(seed=2)
    total, over = 0.0, False
    while not over:
        action = np.full((2, 1), 0.04, np.float32)
        _, reward, terminated, truncated, _ = env.step(action)
        total, over = total + reward[0], bool(terminated[0] or truncated[0])
    env.reset(seed=2)
    held, over = 0.0, False
    while not over:
        _, reward, _, truncated, _ = env.step(np.zeros((2, 1), np.float32))
        held, over = held + reward[0], bool(truncated[0])
    assert total < held


def test_the_same_seed_gives_the_same_lifts():
    env = make(num_envs=4, lifts=3)
    first, _ = env.reset(seed=8)
    again, _ = env.reset(seed=8)
    other, _ = env.reset(seed=9)
    assert np.array_equal(first, again)
    assert not np.array_equal(first, other)


@pytest.mark.parametrize(
    ("settings", "message"),
    [
        ({"behaviour": "smooth", "subject": "S1"}, "behaviour 'any', subject 'draw', or both"),
        ({"task": "hint"}, "unknown task 'hint'"),
        ({"num_envs": 0}, "num_envs must be at least 1, got 0"),
        ({"lifts": 0}, "lifts must be at least 1, got 0"),
        ({"lifts": 5, "plans": 6}, "plans must be 1 to 5, the number of lifts, got 6"),
    ],
)
def test_settings_out_of_range_are_refused(settings, message):
    with pytest.raises(InputError, match=message):
        TwinVectorEnv(**settings)


def test_actions_that_cannot_be_carried_out_are_refused():
    env = make(num_envs=2, lifts=1)
    with pytest.raises(RuntimeError, match="call reset"):
        env.step(np.zeros((2, 1), np.float32))
    env.reset(seed=0)
    for actions in (np.zeros((3, 1)), np.full((2, 1), np.nan)):
        with pytest.raises(ValueError, match=r"2 finite numbers \(n, 1\)"):
            env.step(actions)
    with pytest.raises(InputError, match="no options, got subject"):
        env.reset(options={"subject": "S1"})
