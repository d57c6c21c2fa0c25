"""Learning the reactive controller in the world."""

import json

import numpy as np
import pytest
from colift.agents.control.q_learning import learned_table, right_action
from colift.agents.policies.reactive import Reactive
from colift.benchmark.training.q_learning import learn, learning_trials, table_json

ITERATIONS = 80


@pytest.fixture(scope="module")
def trials():
    return [learn(seed, iterations=ITERATIONS) for seed in (11, 12, 13, 14)]


def test_it_converges_to_the_controller_that_levels_the_table(trials):
    found = [trial for trial in trials if trial.converged_at is not None]
    assert len(found) >= 3
    for trial in found:
        assert np.argmax(trial.table, axis=1).tolist() == [right_action(s) for s in range(5)]
        assert 10 < trial.converged_at <= ITERATIONS


def test_a_reward_is_the_tilt_that_an_action_took_away(trials):
    """At most 4 cm, and as often a loss as the least-visited rule makes it try bad actions."""
    rewards = np.concatenate([trial.rewards for trial in trials])
    assert rewards.max() < 0.055
    assert rewards.min() > -0.055
    assert (rewards > 0.01).mean() > 0.2
    assert (rewards < -0.005).mean() > 0.15


def test_trials_run_over_their_seeds_in_order_and_the_same_seed_learns_the_same(
    trials, monkeypatch
):
    monkeypatch.setattr(
        "colift.benchmark.training.q_learning.learn",
        lambda seed: learn(seed, iterations=ITERATIONS),
    )
    found = list(learning_trials(2, 11))
    assert [trial.table.tobytes() for trial in found] == [
        trial.table.tobytes() for trial in trials[:2]
    ]
    assert trials[0].table.tobytes() != trials[1].table.tobytes()


def test_the_shipped_table_is_a_learned_one_that_levels_from_every_state():
    table = learned_table()
    assert np.argmax(table, axis=1).tolist() == [right_action(state) for state in range(5)]
    assert len(set(np.abs(table).round(6).ravel())) > 20
    assert not table.flags.writeable


def test_what_is_written_can_be_used(trials):
    content = json.loads(table_json(trials[0], 11))
    assert content["provenance"]["command"] == "colift learn reactive --seed 11"
    Reactive(table=content["table"])
