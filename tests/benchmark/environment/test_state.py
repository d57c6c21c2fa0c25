"""The global state of a lift, for centralised critics."""

import numpy as np
import pytest
from colift.agents.agent import HumanObservation
from colift.benchmark.environment import TrueState, env, parallel_env

LIFTS = {
    "level": {},
    "two people": {"partner": "human"},
    "drawn": {"behaviour": "any", "subject": "draw"},
    "intent": {"behaviour": "pivot", "task": "intent"},
    "agree": {"behaviour": "own_hurdle", "task": "agree"},
    "ball": {"behaviour": "ball_smooth", "task": "ball"},
}


def steps(made, count):
    """Yield the observations of a lift in which the robot follows, from its reset on."""
    observations, _ = made.reset(seed=3)
    human = made.scripted_human()
    yield observations
    for _ in range(count):
        robot = np.full(made.action_space("robot").shape, 0.01)
        observations, *_ = made.step({"human": human.act(observations["human"]), "robot": robot})
        yield observations


@pytest.mark.parametrize("name", LIFTS)
def test_it_is_what_is_true_and_what_both_observe(name):
    made = parallel_env(**LIFTS[name])
    for observations in steps(made, 15):
        state, world = made.state(), made.lift.world
        assert made.state_space.contains(state)
        assert state[TrueState.HUMAN_END] == world.human_end[-1]
        assert state[TrueState.ROBOT_VELOCITY] == world.robot_velocity[-1]
        assert state[TrueState.HAND_COMMAND] == made.lift.command
        np.testing.assert_array_equal(
            state[len(TrueState) :], np.concatenate([observations["human"], observations["robot"]])
        )
        state[:] = np.nan
        assert not np.isnan(made.state()).any()
    made.close()


def test_it_is_now_while_the_robot_sees_the_past():
    made = parallel_env("pause", "S2", latency=0.1)
    for _ in steps(made, 15):
        pass
    state = made.state()
    robot_end = state[len(TrueState) + made.observation_space("human").shape[0] + 1]
    assert state[TrueState.ROBOT_END] != pytest.approx(robot_end, abs=1e-3)
    assert state[TrueState.TARGET] == made.lift.target[made.lift.frame - 1]
    made.close()


def test_an_agent_s_observation_that_is_changed_changes_no_state():
    made = parallel_env()
    observations, _ = made.reset(seed=3)
    before = made.state()
    observations["human"][HumanObservation.OWN_HEIGHT] = 7.0
    np.testing.assert_array_equal(made.state(), before)
    made.close()


def test_there_is_none_before_an_episode():
    made = parallel_env()
    with pytest.raises(RuntimeError, match="no episode has begun: call reset"):
        made.state()
    made.close()


def test_in_turns_it_is_the_same():
    made, turns = parallel_env("pause"), env("pause")
    made.reset(seed=5)
    turns.reset(seed=5)
    np.testing.assert_array_equal(turns.state(), made.state())
    assert turns.unwrapped.state_space == made.state_space
    made.close()
    turns.close()
