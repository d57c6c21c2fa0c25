"""Environments that are copied, pickled or forgotten."""

import copy
import gc
import pickle

import numpy as np
import pybullet
import pytest
from colift.benchmark.environment import RobotEnv, parallel_env, training_env


@pytest.mark.parametrize("duplicate", [copy.deepcopy, lambda env: pickle.loads(pickle.dumps(env))])
def test_a_copy_has_a_world_of_its_own(duplicate):
    first = RobotEnv(behaviour="pause", subject="S2")
    second = duplicate(first)
    assert first._env.lift.world.client != second._env.lift.world.client
    alone = [first.reset(seed=3)[0], *(first.step(np.full(1, 0.02))[0] for _ in range(5))]
    with pytest.raises(RuntimeError, match=r"call reset\(\) first"):
        second.step(np.zeros(1))
    second.reset(seed=3)
    first.reset(seed=3)
    for expected in alone[1:]:
        first.step(np.full(1, -0.02))
        np.testing.assert_array_equal(second.step(np.full(1, 0.02))[0], expected)
    first.close()
    second.close()


@pytest.mark.parametrize("seed", [None, 3])
@pytest.mark.parametrize(
    "duplicate", [copy.copy, copy.deepcopy, lambda env: pickle.loads(pickle.dumps(env))]
)
def test_without_a_seed_a_copy_goes_on_as_the_original_would(duplicate, seed):
    first = parallel_env("any", "draw")
    first.reset(seed=seed)
    second = duplicate(first)
    for _ in range(3):
        assert first.reset()[1] == second.reset()[1]
        assert first.lift.seed == second.lift.seed
    first.close()
    second.close()


def test_copies_of_a_new_environment_have_episodes_of_their_own():
    """SuperSuit makes vectors from copies: they must not all learn from the same lifts."""
    first = parallel_env("any", "draw")
    copies = [first, copy.deepcopy(first), pickle.loads(pickle.dumps(first))]
    assert len({made.reset()[1]["robot"]["seed"] for made in copies}) == 3
    for made in copies:
        made.close()


def test_a_copy_of_the_robot_s_side_goes_on_as_the_original_would():
    first = training_env()
    first.reset(seed=3)
    second = copy.deepcopy(first)
    episodes = [first.reset(), second.reset()]
    np.testing.assert_array_equal(episodes[0][0], episodes[1][0])
    assert episodes[0][1] == episodes[1][1]
    first.close()
    second.close()


def test_a_world_that_nobody_has_any_more_is_released():
    env = parallel_env()
    client = env.lift.world.client
    assert pybullet.isConnected(physicsClientId=client)
    del env
    gc.collect()
    assert not pybullet.isConnected(physicsClientId=client)
