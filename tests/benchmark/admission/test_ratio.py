"""The criterion of a ratio, and whether one person decides it."""

import numpy as np
import pytest
from colift.benchmark.admission.criteria import COORDINATION, Criterion
from colift.benchmark.admission.played import Played
from colift.benchmark.admission.ratio import ratio_criterion

STATED = Criterion(letter="a", claim=COORDINATION, what="", bar="", detail="")


def ratio(*by_person, **limits):
    """Return the criterion of two players whose errors have this ratio with each person."""
    errors = np.ones((2, len(by_person), 3))
    errors[0] = np.array(by_person)[:, None]
    people = tuple(f"draw-{i}" for i in range(len(by_person)))
    played = Played(players=("one", "other"), people=people, errors=errors)
    return ratio_criterion(played, "one", "other", STATED, **limits)


@pytest.mark.parametrize(
    ("limits", "verdict"),
    [
        ({"most": 0.9}, "passed"),
        ({"most": 0.7}, "failed"),
        ({"least": 0.7}, "failed"),
        ({"least": 0.7, "beyond": False}, "passed"),
    ],
)
def test_a_ratio_passes_within_its_limit_and_beyond_chance(limits, verdict):
    found = ratio(0.8, 0.82, 0.78, 0.81, **limits)
    assert found.verdict == verdict
    assert found.figure == pytest.approx(0.8, abs=0.01)


def test_one_person_who_decides_is_named():
    found = ratio(0.8, 0.82, 0.78, 0.81, 0.1, most=0.7, beyond=False)
    assert (found.verdict, found.hangs_on) == ("undecided", ("draw-4",))


def test_of_three_people_nobody_is_left_out():
    assert ratio(0.8, 0.82, 0.1, most=0.7, beyond=False).verdict == "passed"
