"""The twin against the engine: unchanged policies, two humans, and wrong constants."""

import jax.numpy as jnp
import pytest
from colift.agents.policies.extrapolate import Extrapolate
from colift.benchmark.episode.lift import Lift
from colift.benchmark.episode.loop import run_episode
from colift.benchmark.suites.catalogue import make_scenario
from colift.benchmark.training.pool import TWIN, straight_line
from colift.benchmark.twin import arm, body, deviation, pair, plant
from colift.benchmark.twin.drawing import draw_lifts
from colift.benchmark.twin.rollout import rollout

ONE = deviation.PEOPLE[:1]


STEADY = [
    (task, policy)
    for task, policies in deviation.POLICIES.items()
    for policy in policies
    if policy not in deviation.AMPLIFYING
]


@pytest.mark.parametrize(("task", "policy"), STEADY)
def test_every_policy_is_within_the_limits(task, policy):
    found = deviation.policy_deviation(policy, task, ONE)
    assert found.within_limits, found


def test_two_humans_are_within_the_limits():
    found = deviation.pair_deviation(ONE)
    assert found.within_limits, found


def test_the_force_at_the_humans_hands_is_that_of_the_engine():
    scenario = make_scenario("pause", "draw-190001")
    engine = run_episode(Lift(scenario), Extrapolate(), 190_001).scores["human_force_n"]
    twin = rollout(TWIN, straight_line, jnp.zeros(1), draw_lifts([(scenario, 190_001)]))
    assert float(twin.force_n[0]) == pytest.approx(engine, rel=0.01)


@pytest.mark.parametrize(
    ("module", "constant", "factor"),
    [(arm, "_LAG", 1.15), (plant, "TABLE_MASS", 1.2), (body, "_ACTIVATION", 0.6)],
)
def test_a_wrong_constant_fails_the_check(monkeypatch, module, constant, factor):
    monkeypatch.setattr(module, constant, factor * getattr(module, constant))
    assert not deviation.policy_deviation("anticipate", people=ONE).within_limits


def test_a_wrong_constant_of_two_humans_fails_the_check(monkeypatch):
    monkeypatch.setattr(pair, "_HALF_MOMENT", 1.1 * pair._HALF_MOMENT)
    assert not deviation.pair_deviation(ONE).within_limits
