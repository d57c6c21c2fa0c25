import math

import numpy as np
import pytest
from colift.agents.control.q_learning import (
    ACTIONS,
    Q_PARAMETERS,
    QLearner,
    QParameters,
    right_action,
    state_of,
)

MIDDLES = (-0.04, -0.02, 0.0, 0.02, 0.04)
"""Height differences in the middle of each state [m]; the outer ones are open."""


def test_parameters_are_the_papers():
    assert ACTIONS == (2, 1, 0, -1, -2)
    assert (Q_PARAMETERS.states, Q_PARAMETERS.position_step) == (5, 0.02)
    assert (Q_PARAMETERS.learning_rate, Q_PARAMETERS.discount) == (0.9, 0.2)


def test_two_updates_by_hand():
    learner = QLearner(0)
    learner.update(1, 3, reward=0.02, following=2)
    # 0.9 (0.02 + 0.2 * 0 - 0)
    assert learner.table[1, 3] == pytest.approx(0.018)
    learner.update(4, 0, reward=-0.01, following=1)
    # 0.9 (-0.01 + 0.2 * 0.018 - 0)
    assert learner.table[4, 0] == pytest.approx(-0.00576)
    assert np.count_nonzero(learner.table) == 2


def test_a_repeated_update_corrects_what_is_left():
    learner = QLearner(0, QParameters(learning_rate=0.5, discount=0.2))
    learner.update(0, 4, reward=1.0, following=0)
    # 0.5 * 1
    assert learner.table[0, 4] == pytest.approx(0.5)
    learner.update(0, 4, reward=1.0, following=0)
    # 0.5 + 0.5 (1 + 0.2 * 0.5 - 0.5)
    assert learner.table[0, 4] == pytest.approx(0.8)


def test_an_update_counts_on_the_best_that_can_follow():
    learner = QLearner(0, QParameters(learning_rate=1.0, discount=0.5))
    learner.table[3] = [-1.0, 2.0, 0.5, 0.0, 1.0]
    learner.update(0, 0, reward=0.25, following=3)
    assert learner.table[0, 0] == pytest.approx(1.25)


def test_least_visited_first():
    learner = QLearner(0)
    learner.visits[2] = [3, 3, 1, 3, 3]
    assert learner.select(2) == 2
    assert learner.visits[2].tolist() == [3, 3, 2, 3, 3]
    learner.visits[2] = [5, 4, 4, 4, 3]
    assert learner.select(2) == 4


def test_every_action_of_a_state_is_tried_equally_often():
    learner = QLearner(8)
    for state in np.random.default_rng(8).integers(5, size=333):
        learner.select(int(state))
        assert np.ptp(learner.visits, axis=1).max() <= 1
    assert learner.visits.sum() == 333


def test_ties_are_broken_at_random_by_the_seed_alone():
    def order(seed):
        learner = QLearner(seed)
        return tuple(learner.select(0) for _ in range(15))

    assert order(1) == order(1)
    assert len({order(seed) for seed in range(20)}) > 10
    first = [order(seed)[0] for seed in range(200)]
    assert all(20 <= first.count(action) <= 60 for action in range(5))


@pytest.mark.parametrize(("state", "difference"), list(enumerate(MIDDLES)))
def test_states_are_one_position_step_each(state, difference):
    assert state_of(difference) == state
    assert state_of(difference + 0.0099) == state
    assert state_of(difference - 0.0099) == state


def test_an_edge_belongs_to_the_state_below():
    assert [state_of(edge) for edge in Q_PARAMETERS.edges] == [0, 1, 2, 3]
    above = [state_of(math.nextafter(edge, 1.0)) for edge in Q_PARAMETERS.edges]
    assert above == [1, 2, 3, 4]


def test_outer_states_are_open():
    assert (state_of(-5.0), state_of(5.0)) == (0, 4)


def test_a_difference_that_is_no_number_is_refused():
    with pytest.raises(ValueError, match="must be a number, got nan"):
        state_of(math.nan)


@pytest.mark.parametrize(("state", "difference"), list(enumerate(MIDDLES)))
def test_the_right_action_levels_best_of_all(state, difference):
    left = [abs(difference - action * Q_PARAMETERS.position_step) for action in ACTIONS]
    assert right_action(state) == int(np.argmin(left))
    assert min(left) == pytest.approx(0.0, abs=1e-12)


def right_table():
    table = np.zeros((5, 5))
    for state in range(5):
        table[state, right_action(state)] = 1.0
    return table


def test_a_table_is_right_if_every_state_is():
    learner = QLearner(0)
    assert not learner.right
    learner.table[:] = right_table()
    assert learner.right


@pytest.mark.parametrize("state", range(5))
def test_one_wrong_or_undecided_state_is_not_right(state):
    learner = QLearner(0)
    learner.table[:] = right_table()
    other = (right_action(state) + 1) % 5
    learner.table[state, other] = 1.0
    assert not learner.right
    learner.table[state, other] = 1.5
    assert not learner.right


def learn(seed, iterations=150):
    """Learn on an ideal table, in position steps; return whether the table was right each time."""
    learner = QLearner(seed)
    difference, right = 0, []
    for _ in range(iterations):
        state = state_of(0.02 * difference)
        action = learner.select(state)
        # The table is not inclined by more than four steps.
        following = min(max(difference - ACTIONS[action], -4), 4)
        reward = abs(difference) - abs(following)
        learner.update(state, action, reward, state_of(0.02 * following))
        difference = following
        right.append(learner.right)
    return np.array(right)


def test_learning_on_an_ideal_table_converges_about_as_fast_as_in_the_paper():
    right = np.array([learn(seed) for seed in range(100)])
    # Level is not right before its four other actions were tried, each other state before one was.
    assert not right[:, :7].any()
    assert right[:, 100:].all()
    iterations = (~right).cumsum(axis=1).argmax(axis=1) + 2
    # The paper's median of ten trials is 36.
    assert 30 <= np.median(iterations) <= 45


def settles(seed, limit, iterations=200):
    """Return whether the greedy actions are right at the end, with an arm that does as it is told.

    An action that would incline the table by more than ``limit`` [m] is cut to it.
    """
    learner, difference = QLearner(seed), 0.0
    for _ in range(iterations):
        state = state_of(difference)
        action = learner.select(state)
        before, change = abs(difference), ACTIONS[action] * Q_PARAMETERS.position_step
        difference -= min(max(change, difference - limit), difference + limit)
        learner.update(state, action, before - abs(difference), state_of(difference))
    return learner.right


def test_it_converges_on_the_lattice_of_whole_steps_and_not_beside_it():
    assert all(settles(seed, 4 * Q_PARAMETERS.position_step) for seed in range(20))
    assert not any(settles(seed, 4.5 * Q_PARAMETERS.position_step) for seed in range(20))
