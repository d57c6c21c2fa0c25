"""The twin against the engine: unchanged policies, two humans, and wrong constants."""

import pytest
from colift.benchmark.twin import arm, body, deviation, pair, plant

ONE = deviation.PEOPLE[:1]


@pytest.mark.parametrize("policy", deviation.POLICIES)
def test_every_policy_is_within_the_limits(policy):
    found = deviation.policy_deviation(policy, ONE)
    assert found.within_limits, found


def test_two_humans_are_within_the_limits():
    found = deviation.pair_deviation(ONE)
    assert found.within_limits, found


@pytest.mark.parametrize(
    ("module", "constant", "factor"),
    [(arm, "_GAIN", 0.9), (plant, "TABLE_MASS", 1.2), (body, "_ACTIVATION", 0.6)],
)
def test_a_wrong_constant_fails_the_check(monkeypatch, module, constant, factor):
    monkeypatch.setattr(module, constant, factor * getattr(module, constant))
    assert not deviation.policy_deviation("anticipate", ONE).within_limits


def test_a_wrong_constant_of_two_humans_fails_the_check(monkeypatch):
    monkeypatch.setattr(pair, "_HALF_MOMENT", 1.1 * pair._HALF_MOMENT)
    assert not deviation.pair_deviation(ONE).within_limits
