"""The recurrent network: its line, its memory, its weights' checks."""

import numpy as np
import pytest
from colift.agents.control.portable import PORTABLE
from colift.agents.control.recurrent import (
    INPUTS,
    GatedNetwork,
    act,
    memory_at_rest,
    network_of,
    read_gated,
)
from colift.agents.control.recurrent_controller import RecurrentController
from colift.agents.policies.extrapolate import Extrapolate
from colift.agents.policies.learned import Learned, LearnedParameters
from colift.base.errors import InputError

UNITS = 3


def weights(scale=0.5, seed=0):
    rng = np.random.default_rng(seed)
    shapes = {
        "inputs": (3 * UNITS, INPUTS),
        "memory": (3 * UNITS, UNITS),
        "bias": (3 * UNITS,),
        "output": (1, UNITS + INPUTS),
        "output_bias": (1,),
    }
    return {name: scale * rng.standard_normal(shape) for name, shape in shapes.items()}


def views(count=8, seed=1):
    """Return observations with a hand that follows its command at once."""
    rng = np.random.default_rng(seed)
    heights, commands = 0.1 + 0.01 * rng.standard_normal((2, count)).cumsum(axis=1)
    return np.array([heights, commands, commands, commands, 0.1 * np.arange(count)]).T


def test_without_corrections_it_is_a_straight_line_above_the_sag():
    controller = RecurrentController(network_of(weights(scale=0.0), "zeros"))
    line = Extrapolate()
    controller.reset(0)
    line.reset(0)
    for view in views():
        assert np.isclose(
            controller.act(view)[0] - controller.internals()["sag"], line.act(view)[0], atol=1e-12
        )


def test_the_units_are_those_of_the_equations():
    network = network_of(weights(), "drawn")
    memory, _ = act(network, memory_at_rest(network), views()[0], PORTABLE)
    view = views()[0]
    inputs = np.array([0, 10 * (view[0] - 0.1), 0, 20 * (view[3] - view[0]), 0, 0.0])
    inputs[5] = 50 * (view[1] - view[0])
    entering = network.inputs @ inputs + network.bias
    update = 1 / (1 + np.exp(-entering[UNITS : 2 * UNITS]))
    # From rest the memory's share is zero, so that the reset gate has no effect.
    assert memory.units == pytest.approx((1 - update) * np.tanh(entering[2 * UNITS :]))


def test_a_lift_does_not_depend_on_the_one_before():
    controller = RecurrentController(network_of(weights(), "drawn"))
    runs = []
    for _ in range(2):
        controller.reset(0)
        runs.append([controller.act(view)[0] for view in views()])
    assert runs[0] == runs[1]


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"bias": np.zeros(4)}, r"bias must have the shape \(9,\), got \(4,\)"),
        ({"output": np.full((1, 9), np.nan)}, "output has numbers that are not finite"),
        ({"memory": np.zeros(5)}, r"1 to 4096 units, memory is \(5,\)"),
        ({"inputs": np.array([["a"]])}, "not the weights of a recurrent policy"),
    ],
)
def test_weights_that_cannot_be_used_are_refused(change, message):
    with pytest.raises(InputError, match=message):
        network_of({**weights(), **change}, "file.npz")


def test_a_missing_array_and_another_file_are_refused(tmp_path):
    some = {name: array for name, array in weights().items() if name != "bias"}
    with pytest.raises(InputError, match="bias"):
        network_of(some, "file.npz")
    (tmp_path / "weights.npz").write_text("no archive")
    with pytest.raises(InputError, match=r"weights\.npz: not an \.npz file of weights"):
        read_gated(tmp_path / "weights.npz")


def test_the_policy_takes_the_weights_of_a_file(tmp_path):
    np.savez(tmp_path / "mine.npz", **weights())
    learned = Learned(parameters=LearnedParameters(model=str(tmp_path / "mine.npz")))
    assert isinstance(learned._network, GatedNetwork)
    assert learned._network.units == UNITS
    with pytest.raises(InputError, match=r"none\.npz"):
        Learned(parameters=LearnedParameters(model=str(tmp_path / "none.npz")))
