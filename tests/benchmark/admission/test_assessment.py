"""The claims of a test of admission, from its criteria, what they hang on, and the control."""

import pytest
from colift.benchmark.admission.assessment import Admission
from colift.benchmark.admission.criteria import ADAPTATION, COORDINATION, Criterion

CLAIMS = {"a": COORDINATION, "b": ADAPTATION, "d": COORDINATION}


def admission(passed, *, hanging=(), control=None):
    """Return a result in which these criteria passed, failed, or were not compared."""
    criteria = tuple(
        Criterion(
            letter=letter,
            claim=CLAIMS[letter],
            what="",
            bar="",
            detail="",
            passed=each,
            hangs_on=("copy",) if letter in hanging else (),
        )
        for letter, each in passed.items()
    )
    return Admission(suite="some", digest="", means={}, criteria=criteria, control=control)


@pytest.mark.parametrize(
    ("passed", "hanging", "partner", "person"),
    [
        ({"a": True, "b": True, "d": None}, "", True, True),
        ({"a": True, "b": False, "d": None}, "", True, False),
        ({"a": True, "b": True, "d": False}, "", False, True),
        ({"a": True, "b": True, "d": True}, "a", False, True),
        ({"a": True, "b": True, "d": True}, "b", True, False),
        ({"a": True, "b": False, "d": True}, "b", True, False),
    ],
)
def test_a_claim_is_shown_if_no_criterion_fails_or_is_undecided(passed, hanging, partner, person):
    found = admission(passed, hanging=hanging)
    assert found.claims == {COORDINATION: partner, ADAPTATION: person}
    assert found.passed is partner


def test_a_document_has_verdicts_and_claims():
    found = admission(
        {"a": True, "b": False, "d": None}, hanging="a", control=admission({"a": True})
    )
    told = found.plain()
    assert [each["verdict"] for each in told["criteria"]] == ["undecided", "failed", "not compared"]
    assert told["claims"] == {COORDINATION: False, ADAPTATION: False}
    assert told["control"]["criteria"][0]["verdict"] == "passed"
    assert told["control"]["passed"] is True


def test_a_test_that_its_control_passes_admits_nothing():
    every = {"a": True, "b": True, "d": True}
    assert admission(every, control=admission({**every, "a": False})).passed
    assert not admission(every, control=admission(every)).passed
