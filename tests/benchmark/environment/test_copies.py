"""Environments that are copied, pickled or forgotten."""

import copy
import gc
import pickle

import numpy as np
import pybullet
import pytest
from colift.benchmark.environment import RobotEnv, parallel_env


@pytest.mark.parametrize("duplicate", [copy.deepcopy, lambda env: pickle.loads(pickle.dumps(env))])
def test_a_copy_has_a_world_of_its_own(duplicate):
    first = RobotEnv(scenario="pause", subject="S2")
    second = duplicate(first)
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


def test_a_world_that_nobody_has_any_more_is_released():
    env = parallel_env()
    client = env.lift.world.client
    assert pybullet.isConnected(physicsClientId=client)
    del env
    gc.collect()
    assert not pybullet.isConnected(physicsClientId=client)
