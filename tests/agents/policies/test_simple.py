import numpy as np
import pytest
from colift.agents.policies.copy import Copy
from colift.agents.policies.hold import Hold
from colift.agents.policies.random import Random, RandomParameters

VIEWS = np.random.default_rng(0).uniform(-0.1, 0.2, (400, 5))


def actions(policy, views=VIEWS, seed=0):
    policy.reset(seed)
    return np.array([policy.act(view)[0] for view in views])


def test_hold_never_moves():
    assert not actions(Hold()).any()


def test_copy_brings_its_command_to_the_seen_height():
    assert VIEWS[:, 3] + actions(Copy()) == pytest.approx(VIEWS[:, 0], abs=1e-15)


@pytest.mark.parametrize("step", [0.02, 0.001])
def test_random_is_even_over_its_steps(step):
    drawn = actions(Random(parameters=RandomParameters(step=step))) / step
    assert np.abs(drawn).max() <= 1.0
    # An even spread over [-1, 1] has mean 0 and variance 1/3; five standard errors.
    assert abs(drawn.mean()) < 5 / np.sqrt(3 * 400)
    assert drawn.var() == pytest.approx(1 / 3, abs=5 * np.sqrt(4 / 45 / 400))
    assert drawn.min() < -0.95
    assert drawn.max() > 0.95


def test_random_depends_on_the_seed_and_on_the_first_view_alone():
    drawn = actions(Random())
    assert (actions(Random()) == drawn).all()
    assert (actions(Random(), seed=1) != drawn).any()
    assert (actions(Random(), views=VIEWS[::-1]) != drawn).any()
    later = VIEWS.copy()
    later[1:] = 0.0
    assert (actions(Random(), views=later) == drawn).all()
