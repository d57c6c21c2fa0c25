"""Student's t distribution, against published quantiles."""

import pytest
from colift.base.errors import InputError
from colift.benchmark.statistics.student import quantile, survival


@pytest.mark.parametrize(
    ("dof", "t"), [(1, 12.7062), (2, 4.30265), (3, 3.18245), (24, 2.06390), (100, 1.98397)]
)
def test_quantiles_are_those_of_the_tables(dof, t):
    assert quantile(0.025, dof) == pytest.approx(t, abs=1e-5)
    assert survival(t, dof) == pytest.approx(0.025, abs=1e-6)


def test_it_is_symmetric():
    assert survival(-1.0, 5) == pytest.approx(1.0 - survival(1.0, 5))
    assert survival(0.0, 5) == pytest.approx(0.5)


@pytest.mark.parametrize("tail", [0.0, 0.6])
def test_a_tail_beyond_the_middle_is_refused(tail):
    with pytest.raises(InputError, match="tail must be above 0 and at most 0.5"):
        quantile(tail, 5)


def test_no_degrees_of_freedom_are_refused():
    with pytest.raises(InputError, match="degrees of freedom must be positive, got 0"):
        survival(1.0, 0)
