"""Criteria of admission on made-up figures."""

import numpy as np
import pytest
from colift.benchmark.admission.criteria import conventions


def test_without_pairs_nothing_is_known():
    assert conventions(None).passed is None


@pytest.mark.parametrize(
    ("played", "figure", "words"),
    [
        ([[2.0, 8.0], [12.0, 3.0]], 4.0, "they do better with themselves"),
        ([[4.0, 2.0], [2.0, 4.0]], 0.5, "they do not"),
    ],
)
def test_what_pairs_do_is_stated(played, figure, words):
    found = conventions(np.array(played))
    assert found.passed
    assert found.figure == pytest.approx(figure)
    assert found.detail.endswith(words)
