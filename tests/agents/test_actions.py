"""What is taken for an action, by all that ask a policy for one."""

import numpy as np
import pytest
from colift.agents.actions import ActionError, action_limit, checked_action
from colift.agents.hardware.decisions import ask
from colift.benchmark.environment import parallel_env

NUMBERS = {
    "float": 0.01,
    "int": 0,
    "NumPy's float": np.float64(0.01),
    "NumPy's short float": np.float32(0.01),
    "array without axes": np.array(0.01),
    "list": [0.01],
    "tuple": (0.01,),
    "array": np.array([0.01]),
}


class Constant:
    """Gives the same action in each step."""

    def __init__(self, action):
        self.action = action

    def reset(self, seed):
        pass

    def act(self, observation):
        return self.action


@pytest.mark.parametrize("number", NUMBERS.values(), ids=NUMBERS)
def test_one_number_is_an_action_with_or_without_a_list(number):
    (value,) = checked_action("robot", number, 1)
    assert type(value) is float
    assert value == pytest.approx(float(np.ravel(number)[0]))


@pytest.mark.parametrize(
    "action", [None, "0.01", b"0.01", [], [0.0, 0.0], [[0.0]], "abc", object(), {}]
)
def test_what_is_no_number_is_refused_by_what_is_due(action):
    with pytest.raises(ActionError, match="robot's action must be 1 number, got "):
        checked_action("robot", action, 1)


def test_a_number_is_no_action_of_many_numbers():
    with pytest.raises(ActionError, match=r"human's action must be 10 numbers, got 0\.1"):
        checked_action("human", 0.1, 10)


@pytest.mark.parametrize("number", [float("nan"), float("inf"), [float("nan")]], ids=repr)
def test_it_is_finite(number):
    with pytest.raises(ActionError, match="finite"):
        checked_action("robot", number, 1)


def test_the_environment_and_the_robots_loop_take_a_number():
    ends = []
    for action in (0.01, [0.01]):
        env = parallel_env()
        env.reset(seed=1)
        env.step({"robot": action, "human": np.zeros(10)})
        ends.append(env.lift.command)
        env.close()
        assert ask(Constant(action), np.zeros(5)).action == 0.01
    assert ends[0] == ends[1] == pytest.approx(0.01)


def test_the_limit_is_the_papers():
    assert action_limit(0.1) == pytest.approx(0.04)
