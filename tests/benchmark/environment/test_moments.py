"""Moments of an episode, to which an environment returns, and copies that go on from one."""

import copy
import pickle

import numpy as np
import pytest
from colift.base.errors import InputError
from colift.benchmark.environment import RobotEnv, parallel_env, training_env

ACTIONS = 0.01 * np.sin(np.arange(200.0))

SETTINGS = (
    {"behaviour": "any", "subject": "draw"},
    {"behaviour": "jerky", "subject": "S3", "latency": 0.05, "control_period": 0.05},
    {"behaviour": "any", "subject": "draw", "task": "agree"},
    {"behaviour": "any", "subject": "draw", "task": "ball"},
    {"behaviour": "any", "subject": "draw", "task": "intent", "reward": "score"},
)


def goes_on(env, steps, first=0):
    """Return all that the robot is told in some steps, whose actions follow from their number."""
    told = []
    for step in range(first, first + steps):
        seen, *rest = env.step(ACTIONS[step : step + 1])
        told.append((seen.tolist(), *rest))
        if any(rest[1:3]):
            break
    return told


@pytest.fixture
def opened():
    made = []
    yield lambda env: made.append(env) or env
    for env in made:
        env.close()


@pytest.mark.parametrize("settings", SETTINGS, ids=lambda each: each.get("task", "level"))
@pytest.mark.parametrize("passed", [0, 1, 17])
def test_from_a_moment_on_all_is_as_it_was(settings, passed, opened):
    env = opened(RobotEnv(**settings))
    _, infos = env.reset(seed=5)
    goes_on(env, passed)
    moment = env.save()
    expected = goes_on(env, 12, passed)
    for _ in range(2):
        _, again = env.restore(moment)
        assert again == infos
        assert goes_on(env, 12, passed) == expected
    other = opened(RobotEnv(**settings))  # Nothing has begun there.
    other.restore(pickle.loads(pickle.dumps(moment)))
    assert goes_on(other, 12, passed) == expected


@pytest.mark.parametrize("duplicate", [copy.deepcopy, lambda env: pickle.loads(pickle.dumps(env))])
@pytest.mark.parametrize("make", [training_env, lambda: RobotEnv(behaviour="pause", subject="S2")])
def test_a_copy_goes_on_with_the_episode(make, duplicate, opened):
    first = opened(make())
    first.reset(seed=3)
    goes_on(first, 9)
    second = opened(duplicate(first))
    expected = goes_on(first, 12, 9)
    assert goes_on(second, 12, 9) == expected
    assert first.reset()[0].tolist() == second.reset()[0].tolist()


def test_both_agents_return_to_the_moment_with_their_rewards(opened):
    env = opened(parallel_env("pause", "S3"))
    env.reset(seed=2)
    human = env.scripted_human()

    def played(human, steps):
        return [
            env.step({"human": human.act(env.observe("human")), "robot": ACTIONS[:1]})[1:]
            for _ in range(steps)
        ]

    env.observe = lambda agent: env.lift.human_observation()
    played(human, 15)
    moment, state = env.save(), env.state()
    expected = played(human, 10)
    observations, _ = env.restore(moment)
    np.testing.assert_array_equal(env.state(), state)
    np.testing.assert_array_equal(env.lift.human_observation(), observations["human"])
    assert played(env.scripted_human(), 10) == expected
    env.restore(moment)
    played(env.scripted_human(), 4)
    assert played(env.scripted_human(), 6) == expected[4:]  # One who comes later has kept up, too.


def test_an_episode_that_is_over_stays_over(opened):
    env = opened(parallel_env())
    env.reset(seed=1)
    human = env.scripted_human()
    while env.agents:
        env.step({"human": human.act(None), "robot": 0.0})
    moment = env.save()
    env.reset()
    env.restore(moment)
    assert env.agents == []
    with pytest.raises(RuntimeError, match="the episode is over"):
        env.step({"human": human.act(None), "robot": 0.0})


def test_a_moment_of_another_environment_is_refused(opened):
    env = opened(RobotEnv())
    drawn = opened(RobotEnv(behaviour="any", subject="draw"))
    seen = env.reset(seed=1)[0].tolist()
    for changes, told in (
        ({"latency": 0.2}, r"its latency is 0\.2, not 0\.1"),
        ({"behaviour": "pause"}, "its behaviour is 'pause', not 'smooth'"),
        ({"subject": "S3"}, "its subject is 'S3', not 'S1'"),
        ({"task": "ball", "behaviour": "ball_pause"}, "its task is 'ball', not 'level'"),
    ):
        other = opened(RobotEnv(**changes))
        other.reset(seed=1)
        with pytest.raises(InputError, match=told):
            env.restore(other.save())
        if "task" in changes or "latency" in changes:
            with pytest.raises(InputError, match=told):
                drawn.restore(other.save())
    assert env.reset(seed=1)[0].tolist() == seen  # It is what it was.
    with pytest.raises(RuntimeError, match="no episode has begun"):
        opened(RobotEnv()).save()
