"""The shipped policy of a trained network: its inputs, its arithmetic, refused weights."""

import math
from itertools import pairwise

import numpy as np
import pytest
from colift.agents.policies.extrapolate import Extrapolate
from colift.agents.submissions.network.policy import (
    CORRECTION,
    Network,
    Policy,
    Senses,
    line,
    scales,
)
from colift.testing import check_policy


def weights(steps=2, hidden=(3,), seed=0):
    rng = np.random.default_rng(seed)
    sizes = [7 + steps, *hidden, 1]
    made = {"linear": rng.normal(0, 0.3, sizes[0])}
    for i, (size, outputs) in enumerate(pairwise(sizes)):
        made[f"w{i}"] = rng.normal(0, 0.3, (outputs, size))
        made[f"b{i}"] = rng.normal(0, 0.3, outputs)
    return made


def test_it_is_a_policy():
    check_policy(lambda: Policy(Network(weights(hidden=(4, 3)))))


def test_without_weights_it_extrapolates():
    zero = {name: np.zeros_like(value) for name, value in weights().items()}
    policy, extrapolate = Policy(Network(zero)), Extrapolate()
    rng = np.random.default_rng(1)
    policy.reset(0)
    extrapolate.reset(0)
    for view in rng.normal(0, 0.05, (20, 5)):
        assert policy.act(view) == pytest.approx(extrapolate.act(view).item())


def test_its_correction_is_the_network_s():
    made, senses = weights(), np.linspace(-0.02, 0.03, 9)
    inputs = (senses / scales(2)).tolist()
    hidden = [
        math.tanh(sum(w * x for w, x in zip(row, inputs, strict=True)) + b)
        for row, b in zip(made["w0"], made["b0"], strict=True)
    ]
    output = sum(w * x for w, x in zip(made["linear"], inputs, strict=True))
    output += sum(w * x for w, x in zip(made["w1"][0], hidden, strict=True)) + made["b1"][0]
    wanted = CORRECTION * math.tanh(output)
    assert Network(made).correction(senses) == pytest.approx(wanted)


def test_the_line_goes_on_at_the_last_pace():
    senses = Senses(2)
    for height in (0.0, 0.01, 0.03):
        inputs = senses(np.array([height, 0.0, 0.0, 0.005, 0.0]))
    assert 0.005 + line(inputs) == pytest.approx(0.03 + 2 * 0.02)


@pytest.mark.parametrize(
    ("change", "told"),
    [
        ({"w0": np.zeros((3, 8))}, r"w0 must be \(3, 9\) and b0 \(3,\), got \(3, 8\) and \(3,\)"),
        ({"b1": np.zeros(2)}, r"w1 must be \(1, 3\) and b1 \(1,\), got \(1, 3\) and \(2,\)"),
        ({"w1": np.full((1, 3), np.nan)}, "weights must be finite, w1 has other numbers"),
        ({"linear": np.zeros(7)}, "linear must have more than 7 weights, got 7"),
        ({"w7": np.zeros(7)}, "weights must be w0, b0, w1, b1, ... and linear, got"),
    ],
)
def test_weights_that_fit_nothing_are_refused(change, told):
    with pytest.raises(ValueError, match=told):
        Network({**weights(), **change})
