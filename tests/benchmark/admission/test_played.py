"""The table of errors of a test of admission."""

import numpy as np
import pytest
from colift.base.errors import InputError
from colift.benchmark.admission.played import Played
from colift.benchmark.results.scores import ScoreTable

STRATA = tuple((way, who) for way in ("up", "down") for who in ("draw-1", "draw-2", "draw-3"))


def scores(values, strata=STRATA):
    """Return a table of errors [mm]."""
    return ScoreTable(strata=strata, values={"rmse_mm": values})


def test_errors_are_by_player_person_and_lift():
    found = Played.of({"one": scores([1.0, 2, 3, 4, 5, 6]), "other": scores([7.0] * 6)})
    assert found.people == ("draw-1", "draw-2", "draw-3")
    assert found.errors[0].tolist() == [[1.0, 4.0], [2.0, 5.0], [3.0, 6.0]]
    assert found.means == {"one": 3.5, "other": 7.0}


def test_a_player_and_a_person_can_be_left_out():
    found = Played.of({"one": scores([1.0, 2, 3, 4, 5, 6]), "other": scores([7.0] * 6)})
    rest = found.without(players=["other"], person="draw-2")
    assert (rest.players, rest.people) == (("one",), ("draw-1", "draw-3"))
    assert rest.errors.tolist() == [[[1.0, 4.0], [3.0, 6.0]]]


@pytest.mark.parametrize(
    ("strata", "words"),
    [
        (STRATA[:5], "every person with every behaviour"),
        (STRATA[:3], "3 people or more with 2 lifts or more each, got 3 people with 1"),
        (STRATA[:2] + STRATA[3:5], "3 people or more, got 2"),
    ],
)
def test_too_few_or_unlike_lifts_are_refused(strata, words):
    with pytest.raises(InputError, match=words):
        Played.of({"one": scores(np.ones(len(strata)), strata)})


def test_an_error_of_nothing_is_refused():
    with pytest.raises(InputError, match="a positive error in every lift"):
        Played.of({"one": scores([0.0, 2, 3, 4, 5, 6])})
