"""The linear predictor: translation, straight lines, latency."""

import numpy as np
import pytest
from colift.agents.policies.extrapolate import Extrapolate
from colift.agents.policies.linear import Linear, LinearParameters
from colift.base.errors import InputError

RISING = 0.02 + 0.01 * np.arange(14)


def commands(heights, policy=None, period=0.1):
    """Return the command after each sample, which the hand reaches."""
    policy = policy or Linear()
    policy.reset(0)
    command, given = 0.0, []
    for k, height in enumerate(heights):
        view = np.array([height, 0.0, command, command, period * k])
        command += float(policy.act(view)[0])
        given.append(command)
    return np.array(given)


def test_a_human_at_rest_is_met_at_any_height():
    for height in (-0.02, 0.0, 0.2):
        assert commands([height] * 5) == pytest.approx([height] * 5)


def test_the_same_motion_from_another_height_gets_the_same_rises():
    assert commands(RISING + 0.1) - 0.1 == pytest.approx(commands(RISING))


def test_a_steady_human_is_nearly_met():
    ahead = commands(RISING)[10:] - RISING[10:]
    assert ahead == pytest.approx(np.full(4, 0.02), abs=0.003)


def test_it_predicts_further_with_older_samples():
    heights = 0.001 * np.arange(14) ** 2
    later, now = (
        commands(heights, Linear(parameters=LinearParameters(latency=latency)))[-1]
        for latency in (0.2, 0.0)
    )
    assert now < commands(heights)[-1] < later


def test_it_is_nearer_to_an_accelerating_human_than_a_straight_line():
    heights = 0.1 * (10 * (t := np.arange(21) / 20) ** 3 - 15 * t**4 + 6 * t**5)
    missed = [
        np.abs(commands(heights, policy)[:-2] - heights[2:]).mean()
        for policy in (Linear(), Extrapolate())
    ]
    assert missed[0] < missed[1]


def test_a_sample_s_spacing_in_time_counts_not_its_number():
    slow = commands(RISING)
    dense = commands(np.interp(np.arange(27) / 2, np.arange(14), RISING), period=0.05)
    ahead = slow[-1] - RISING[-1], dense[-1] - RISING[-1]
    assert ahead[1] == pytest.approx(0.75 * ahead[0], abs=0.003)


@pytest.mark.parametrize("latency", [-0.1, np.inf, np.nan])
def test_a_latency_must_make_sense(latency):
    with pytest.raises(InputError, match=f"latency must be a number of at least 0, got {latency}"):
        LinearParameters(latency=latency)


def test_a_model_that_is_none_is_named(tmp_path):
    with pytest.raises(InputError, match=r"none\.json: cannot be read"):
        Linear(parameters=LinearParameters(model=str(tmp_path / "none.json")))
