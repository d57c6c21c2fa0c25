"""Least squares find the line that made the data, and every lift counts by its error."""

import numpy as np
import pytest
from colift.agents.control.linear_forecast import TAPS
from colift.base.errors import InputError
from colift.benchmark.training.linear import HORIZONS, fitted, learn_linear, samples


def test_the_weights_that_made_the_data_are_found():
    rng = np.random.default_rng(0)
    weights = rng.normal(size=(3, TAPS - 1))
    changes = [rng.normal(0.0, 0.01, (many, TAPS - 1)) for many in (40, 90)]
    noisy = [each @ weights.T + rng.normal(0.0, 1e-6, (len(each), 3)) for each in changes]
    found, errors = fitted(changes, noisy)
    assert found == pytest.approx(weights, abs=1e-3)
    assert errors == pytest.approx([1e-6] * 3, rel=0.2)


def test_no_other_weights_have_a_lower_mean_error_of_lifts():
    rng = np.random.default_rng(1)
    changes = [rng.normal(size=(50, 2)) for _ in range(6)]
    sizes = (0.1, 0.1, 0.1, 0.1, 0.1, 10.0)
    rises = [
        each @ rng.normal(1.0, 0.3, (2, 1)) + size * rng.normal(size=(50, 1))
        for each, size in zip(changes, sizes, strict=True)
    ]

    def mean_error(weights):
        pairs = zip(changes, rises, strict=True)
        return np.mean([np.sqrt(((x @ weights.T - y) ** 2).mean()) for x, y in pairs])

    found, errors = fitted(changes, rises)
    assert mean_error(found) == pytest.approx(errors[0])
    for step in np.array([(0.01, 0.0), (-0.01, 0.0), (0.0, 0.01), (0.0, -0.01)]):
        assert mean_error(found + step) > errors[0]


def test_the_same_lifts_give_the_same_weights_and_later_heights_are_harder():
    one, again = (learn_linear(lifts=5, first_seed=100_200) for _ in range(2))
    assert (one.weights == again.weights).all()
    errors = one.provenance["mean_rmse_mm"]
    assert errors == sorted(errors)
    assert one.provenance["seeds"] == [100_200, 100_204]
    changes, rises = samples(100_200)
    assert changes.shape == (len(rises), TAPS - 1)
    assert rises.shape == (len(changes), len(HORIZONS))


def test_seeds_of_suites_are_not_learned_from():
    with pytest.raises(InputError, match="learning needs at least 2 lifts, with seeds 100000"):
        learn_linear(lifts=3, first_seed=0)
