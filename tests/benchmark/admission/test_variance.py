"""Shares of variance, on tables of which they are known."""

import numpy as np
import pytest
from colift.base.errors import InputError
from colift.benchmark.admission.variance import variance_shares


def test_policies_that_differ_with_everybody_alike_have_no_interaction():
    shares = variance_shares(np.add.outer([1.0, 2.0, 4.0], [0.0, 0.5]))
    assert shares.interaction == pytest.approx(0.0)
    assert shares.policy + shares.human == pytest.approx(1.0)


def test_policies_that_each_suit_one_person_have_nothing_else():
    assert variance_shares(np.eye(3)).interaction == pytest.approx(1.0)


def test_people_alone():
    assert variance_shares([[1.0, 2.0], [1.0, 2.0]]).human == 1.0


@pytest.mark.parametrize("table", [[[1.0, 2.0]], [[1.0], [2.0]], [[1.0, 1.0], [1.0, 1.0]]])
def test_what_has_no_shares_is_refused(table):
    with pytest.raises(InputError):
        variance_shares(table)
