import itertools
import math

import numpy as np
import pytest
from colift.agents.estimators.confidence import LITERAL, Confidence, likelihood
from colift.base.errors import InputError

ROOT = "standard deviation as rho"
FORGETTING = [0.05, 0.45, 0.9, 1.0]


@pytest.mark.parametrize(
    ("error", "variance", "reading", "expected"),
    [
        (0.0, 4.0, LITERAL, 1.0),
        (4.0, 4.0, LITERAL, math.exp(-1 / 2)),
        (-8.0, 4.0, LITERAL, math.exp(-2)),
        (2.0, 0.5, LITERAL, math.exp(-8)),
        (0.0, 4.0, ROOT, 1.0),
        (4.0, 4.0, ROOT, math.exp(-2)),
        (-8.0, 4.0, ROOT, math.exp(-8)),
        (2.0, 0.5, ROOT, math.exp(-4)),
    ],
)
def test_likelihood_by_hand(error, variance, reading, expected):
    assert likelihood(error, variance, reading) == pytest.approx(expected, rel=1e-14)


def test_the_literal_reading_is_the_default():
    assert likelihood(3.0, 4.0) == likelihood(3.0, 4.0, LITERAL) != likelihood(3.0, 4.0, ROOT)


@pytest.mark.parametrize("reading", [LITERAL, ROOT])
def test_likelihood_is_positive_symmetric_and_falls_with_the_error(reading):
    values = [likelihood(error, 2.0, reading) for error in np.linspace(0.0, 30.0, 50)]
    assert values[0] == 1.0
    assert all(0 < smaller < larger for larger, smaller in itertools.pairwise(values))
    assert likelihood(-3.0, 2.0, reading) == likelihood(3.0, 2.0, reading)


def test_readings_agree_at_a_variance_of_one():
    assert likelihood(0.7, 1.0, LITERAL) == likelihood(0.7, 1.0, ROOT)


@pytest.mark.parametrize("forgetting", FORGETTING)
def test_recursion_is_the_explicit_sum(forgetting):
    likelihoods = np.random.default_rng(3).uniform(size=80)
    confidence = Confidence(forgetting)
    for k in range(1, len(likelihoods) + 1):
        weights = forgetting ** np.arange(k)
        explicit = (weights * likelihoods[:k][::-1]).sum() / weights.sum()
        assert confidence.update(likelihoods[k - 1]) == pytest.approx(explicit, rel=1e-12)


def test_two_steps_by_hand():
    confidence = Confidence(0.5)
    assert confidence.update(0.8) == pytest.approx(0.8)
    assert confidence.update(0.2) == pytest.approx((0.2 + 0.5 * 0.8) / 1.5)


def test_nothing_forgotten_is_the_mean():
    likelihoods = np.random.default_rng(4).uniform(size=50)
    confidence = Confidence(1.0)
    values = [confidence.update(value) for value in likelihoods]
    assert values[-1] == pytest.approx(likelihoods.mean(), rel=1e-12)


@pytest.mark.parametrize("forgetting", FORGETTING)
@pytest.mark.parametrize("constant", [0.3, 1.0])
def test_weights_are_normalised(forgetting, constant):
    confidence = Confidence(forgetting)
    values = [confidence.update(constant) for _ in range(100)]
    assert values == pytest.approx([constant] * 100, rel=1e-12)
    assert max(values) <= 1.0


@pytest.mark.parametrize("forgetting", FORGETTING)
def test_confidence_stays_between_the_likelihoods_so_far(forgetting):
    likelihoods = np.random.default_rng(5).uniform(size=200)
    confidence = Confidence(forgetting)
    for k, value in enumerate(likelihoods, start=1):
        seen = likelihoods[:k]
        assert seen.min() - 1e-12 <= confidence.update(value) <= seen.max() + 1e-12


def test_a_small_factor_forgets_faster():
    fast, slow = Confidence(0.1), Confidence(0.9)
    for _ in range(20):
        fast.update(1.0)
        slow.update(1.0)
    assert fast.update(0.0) == pytest.approx(0.1, abs=1e-9)
    assert slow.update(0.0) > 0.8


@pytest.mark.parametrize("forgetting", [0.0, -0.45, 1.01, math.nan])
def test_an_impossible_factor_is_refused(forgetting):
    with pytest.raises(InputError, match=rf"in \(0, 1\], got {forgetting}"):
        Confidence(forgetting)
