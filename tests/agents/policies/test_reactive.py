import numpy as np
import pytest
from colift.agents.agent import RobotObservation
from colift.agents.control.q_learning import ACTIONS, QParameters, learned_table, right_action
from colift.agents.policies.reactive import Reactive


def seen(human=0.0, robot=0.0, hand=0.0, command=0.0, time=0.0):
    return np.array([human, robot, hand, command, time])


def test_the_shipped_table_is_right_in_every_state():
    table = learned_table()
    assert table.shape == (5, 5)
    for state, row in enumerate(table):
        assert np.flatnonzero(row == row.max()).tolist() == [right_action(state)]


def test_the_shipped_table_cannot_be_changed():
    with pytest.raises(ValueError, match="read-only"):
        learned_table()[0, 0] = 9.0


@pytest.mark.parametrize(
    ("difference", "step"),
    [
        (-0.20, -0.04),
        (-0.04, -0.04),
        (-0.02, -0.02),
        (-0.009, 0.0),
        (0.0, 0.0),
        (0.009, 0.0),
        (0.02, 0.02),
        (0.04, 0.04),
        (0.20, 0.04),
    ],
)
@pytest.mark.parametrize("hand", [-0.05, 0.0, 0.17])
def test_steps_towards_level(difference, step, hand):
    policy = Reactive()
    policy.reset(0)
    assert policy.act(seen(human=hand + difference, hand=hand)) == pytest.approx([step])


def test_sees_the_human_end_and_the_own_hand_alone():
    policy = Reactive()
    policy.reset(0)
    rng = np.random.default_rng(2)
    for _ in range(50):
        view = rng.uniform(-0.2, 0.2, 5)
        other = view.copy()
        for hidden in (
            RobotObservation.ROBOT_END,
            RobotObservation.HAND_COMMAND,
            RobotObservation.TIME,
        ):
            other[hidden] = rng.uniform(-0.2, 0.2)
        assert policy.step(view) == policy.step(other)
    assert policy.step(seen(human=0.02)) == -policy.step(seen(hand=0.02)) == 0.02


def test_levels_an_ideal_table_and_rests():
    policy = Reactive()
    policy.reset(0)
    hand, heights = 0.0, []
    for _ in range(10):
        hand += policy.act(seen(human=0.145, hand=hand))[0]
        heights.append(hand)
    assert heights[:3] == pytest.approx([0.04, 0.08, 0.12])
    assert heights[3:] == pytest.approx([0.14] * 7)


def test_follows_a_given_table_in_given_steps():
    table = np.zeros((5, 5))
    table[:, ACTIONS.index(1)] = 1.0
    policy = Reactive(table=table.tolist(), parameters=QParameters(position_step=0.005))
    policy.reset(0)
    assert policy.act(seen(human=-0.1)) == pytest.approx([0.005])


def test_a_lost_marker_is_no_reason_to_move():
    with pytest.raises(ValueError, match="must be a number"):
        Reactive().act(seen(human=np.nan))
