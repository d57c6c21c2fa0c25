"""The claims of a test of admission, from its criteria, what they hang on, and the control."""

import pytest
from colift.benchmark.admission.assessment import Admission
from colift.benchmark.admission.criteria import ADAPTATION, COORDINATION, Criterion
from colift.benchmark.admission.fragility import Fragile

CLAIMS = {"a": COORDINATION, "b": ADAPTATION, "d": COORDINATION}


def admission(passed, *, hanging=(), control=None):
    """Return a result in which these criteria passed, failed, or were not compared."""
    criteria = tuple(
        Criterion(letter=letter, claim=CLAIMS[letter], what="", bar="", detail="", passed=each)
        for letter, each in passed.items()
    )
    fragile = tuple(Fragile(letter=each, without="copy", passes=False) for each in hanging)
    return Admission(
        suite="some", digest="", means={}, criteria=criteria, fragile=fragile, control=control
    )


@pytest.mark.parametrize(
    ("passed", "hanging", "partner", "person"),
    [
        ({"a": True, "b": True, "d": None}, "", True, True),
        ({"a": True, "b": False, "d": None}, "", True, False),
        ({"a": True, "b": True, "d": False}, "", False, True),
        ({"a": True, "b": True, "d": True}, "a", False, True),
        ({"a": True, "b": True, "d": True}, "b", True, False),
    ],
)
def test_a_claim_is_shown_if_none_of_its_criteria_fails_or_hangs(passed, hanging, partner, person):
    found = admission(passed, hanging=hanging)
    assert found.claims == {COORDINATION: partner, ADAPTATION: person}
    assert found.passed is partner


def test_a_test_that_its_control_passes_admits_nothing():
    every = {"a": True, "b": True, "d": True}
    assert admission(every, control=admission({**every, "a": False})).passed
    assert not admission(every, control=admission(every)).passed
