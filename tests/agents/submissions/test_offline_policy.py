"""The policy that is learned from data: its window of the past, and its network."""

import numpy as np
import pytest
from colift.agents.submissions.offline.policy import (
    COMMANDS,
    INPUTS,
    LIMIT,
    STEPS,
    Network,
    Policy,
    Window,
)


def observation(human, end=0.0, hand=0.0, command=0.0):
    return np.array([human, end, hand, command, 0.1])


def weights(**changes):
    rng = np.random.default_rng(3)
    made = {
        "centre": rng.normal(0.0, 0.1, INPUTS),
        "deviation": rng.uniform(0.5, 1.5, INPUTS),
        "w0": rng.normal(0.0, 1.0, (4, INPUTS)),
        "b0": rng.normal(0.0, 1.0, 4),
        "w1": rng.normal(0.0, 1.0, (1, 4)),
        "b1": rng.normal(0.0, 1.0, 1),
    }
    return {name: value for name, value in {**made, **changes}.items() if value is not None}


def test_before_a_lift_everything_stood_still():
    window = Window()
    window.reset()
    inputs = window(observation(0.2, end=0.19, hand=0.17, command=0.18))
    assert inputs.shape == (INPUTS,)
    assert inputs[:4] == pytest.approx([0.2, -0.02, -0.01, -0.01])
    assert not inputs[4:].any()


def test_changes_come_newest_first_and_are_forgotten():
    window = Window()
    window.reset()
    for i in range(STEPS + 5):
        inputs = window(observation(0.001 * i * i, command=0.002 * i))
    assert inputs[4 : 4 + COMMANDS] == pytest.approx([0.002] * COMMANDS)
    assert inputs[4 + COMMANDS] == pytest.approx(0.001 * ((STEPS + 4) ** 2 - (STEPS + 3) ** 2))
    assert np.all(np.diff(inputs[4 + COMMANDS :]) < 0)
    window.reset()
    assert not window(observation(0.3))[4:].any()


def test_the_network_is_a_perceptron_within_the_speed_of_the_hands():
    known = weights()
    inputs = np.linspace(-1.0, 1.0, INPUTS)
    hidden = np.tanh(known["w0"] @ ((inputs - known["centre"]) / known["deviation"]) + known["b0"])
    wanted = LIMIT * np.tanh(known["w1"] @ hidden + known["b1"])[0]
    assert Network(known)(inputs) == pytest.approx(wanted)
    assert abs(Network(weights(b1=np.array([99.0])))(inputs)) == pytest.approx(LIMIT)


def test_a_lift_depends_on_nothing_before_it():
    policy = Policy(Network(weights()))
    policy.reset(0)
    first = [policy.act(observation(0.01 * i)).tolist() for i in range(5)]
    policy.reset(1)
    assert [policy.act(observation(0.01 * i)).tolist() for i in range(5)] == first


@pytest.mark.parametrize(
    ("changes", "told"),
    [
        ({"w0": np.zeros((4, 3))}, r"w0 must be \(4, 22\) and b0 \(4,\), got \(4, 3\)"),
        ({"w1": np.zeros((2, 4))}, r"w1 must be \(1, 4\)"),
        ({"b0": None}, "weights must be centre, deviation, w0, b0"),
        ({"extra": np.zeros(1)}, "weights must be centre"),
        ({"centre": np.zeros(3)}, r"must be \(22,\)"),
        ({"b1": np.array([np.nan])}, "must be finite, b1"),
    ],
)
def test_other_weights_are_refused_by_name(changes, told):
    with pytest.raises(ValueError, match=told):
        Network(weights(**changes))
