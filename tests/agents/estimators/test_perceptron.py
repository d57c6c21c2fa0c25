import itertools
import json

import numpy as np
import pytest
from colift.agents.estimators.perceptron import Perceptron
from colift.base.errors import InputError


def made(*sizes, seed=0):
    rng = np.random.default_rng(seed)
    return Perceptron(
        centre=rng.normal(size=sizes[0]),
        deviation=rng.uniform(0.5, 2.0, sizes[0]),
        weights=tuple(rng.normal(size=shape) for shape in itertools.pairwise(sizes)),
        biases=tuple(rng.normal(size=size) for size in sizes[1:]),
        gain=rng.uniform(0.5, 2.0, sizes[-1]),
    )


def test_outputs_are_those_of_rectified_layers():
    """max(0, 3 * (5 - 1) / 2 - 4) = 2 and max(0, -3 * 2 + 1) = 0; 10 (7 * 2 + 11 * 0 - 5) = 90."""
    one = Perceptron(
        centre=np.array([1.0]),
        deviation=np.array([2.0]),
        weights=(np.array([[3.0, -3.0]]), np.array([[7.0], [11.0]])),
        biases=(np.array([-4.0, 1.0]), np.array([-5.0])),
        gain=np.array([10.0]),
    )
    assert one([5.0]) == pytest.approx([90.0])
    assert one([-3.0]) == pytest.approx([10.0 * (11.0 * 7.0 - 5.0)])


def test_many_inputs_at_once_are_those_one_by_one():
    network = made(4, 6, 5, 3)
    inputs = np.random.default_rng(1).normal(size=(7, 4))
    assert network(inputs) == pytest.approx(np.array([network(row) for row in inputs]))


def test_json_keeps_it_to_five_digits():
    network = made(4, 6, 3)
    again = Perceptron.of(json.loads(json.dumps(network.plain())))
    inputs = np.random.default_rng(1).normal(size=(50, 4))
    assert again(inputs) == pytest.approx(network(inputs), rel=1e-3, abs=1e-3)
    assert again.plain() == network.plain()


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"weights": ([[1.0, 2.0]],)}, "layers must have the shapes"),
        ({"weights": ()}, "layers must have the shapes"),
        ({"spread": [1.0, 1.0]}, "one deviation per input"),
        ({"gain": [1.0, 1.0]}, "one gain per output"),
        ({"gain": [np.inf]}, "finite"),
    ],
)
def test_parts_that_do_not_fit_are_refused(changes, message):
    parts = {
        "centre": [0.0],
        "spread": [1.0],
        "weights": ([[1.0]],),
        "biases": ([0.0],),
        "gain": [1.0],
    }
    with pytest.raises(InputError, match=message):
        Perceptron.of({**parts, **changes})
