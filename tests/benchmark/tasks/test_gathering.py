"""The squares of a lift's frames, gathered as one number: a sum, or the best stay."""

import numpy as np
import pytest
from colift.benchmark.tasks.touch import gathered

SQUARES = np.random.default_rng(4).random((90, 3))


def test_without_a_stay_it_is_the_sum():
    assert gathered(SQUARES, 0) == pytest.approx(SQUARES.sum(axis=0))


@pytest.mark.parametrize("stay", [1, 20, 90])
def test_a_stay_is_the_least_mean_of_successive_frames(stay):
    means = [SQUARES[i : i + stay].mean(axis=0) for i in range(90 - stay + 1)]
    assert gathered(SQUARES, stay) == pytest.approx(np.min(means, axis=0))
    assert gathered(SQUARES[:, 1], stay) == pytest.approx(gathered(SQUARES, stay)[1])


def test_of_a_shorter_lift_it_is_the_mean():
    assert gathered(SQUARES[:7], 20) == pytest.approx(SQUARES[:7].mean(axis=0))
