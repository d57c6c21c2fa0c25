"""Straight lines are met exactly; noise is amplified as stated."""

import numpy as np
import pytest
from colift.agents.policies.extrapolate import Extrapolate, ExtrapolateParameters
from colift.base.errors import InputError


def commands(heights, steps=2.0):
    """Return the command after each sample, which the hand reaches."""
    policy = Extrapolate(parameters=ExtrapolateParameters(steps=steps))
    policy.reset(0)
    command, given = 0.0, []
    for k, height in enumerate(heights):
        command += float(policy.act(np.array([height, 0.0, command, command, 0.1 * k]))[0])
        given.append(command)
    return np.array(given)


@pytest.mark.parametrize("steps", [0.0, 1.0, 2.0, 3.5])
def test_a_steady_human_is_met(steps):
    heights = 0.02 + 0.01 * np.arange(10)
    given = commands(heights, steps)
    assert given[0] == heights[0]
    assert given[1:] == pytest.approx(heights[1:] + 0.01 * steps, abs=1e-15)


def test_acceleration_leaves_an_error_of_three_times_its_step_change():
    """For z = a k^2 / 2 the line falls short of two steps ahead by a (d^2 + d) / 2 = 3 a."""
    k = np.arange(12)
    heights = 0.001 * k**2 / 2
    assert heights[4:] - commands(heights)[2:-2] == pytest.approx(np.full(8, 0.003), abs=1e-12)


def test_noise_is_amplified_as_the_docstring_says():
    noise = np.random.default_rng(1).normal(0.0, 1.0, 20_000)
    assert commands(noise)[1:].std() == pytest.approx(np.sqrt(3**2 + 2**2), rel=0.02)


@pytest.mark.parametrize("steps", [-1.0, np.inf, np.nan])
def test_steps_must_make_sense(steps):
    with pytest.raises(InputError, match=rf"steps must be a number of at least 0, got {steps}"):
        ExtrapolateParameters(steps=steps)
