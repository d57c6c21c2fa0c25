"""The commands around `anticipate` as a user meets them."""

import json

import pytest
from colift.agents.control.anticipation import read_anticipation


def test_what_is_learned_can_be_run_and_says_where_it_came_from(colift, tmp_path):
    pytest.importorskip("sklearn")
    options = ("--lifts", "3", "--rounds", "1", "--seed", "100500", "--jobs", "1")
    code, told, errors = colift("learn", "anticipate", *options, "--out", "model.json")
    assert (code, errors) == (0, "")
    assert "+100 ms" in told
    text = (tmp_path / "model.json").read_text()
    assert read_anticipation(text).provenance["command"] == (
        "colift learn anticipate --lifts 3 --rounds 1 --seed 100500"
    )
    policy = "anticipate,model=model.json"
    options = ("--suite", "quick-v1", "--seeds", "40:41", "--jobs", "1", "--json")
    code, told, _ = colift("run", policy, *options)
    assert code == json.loads(told)["summary"]["failed"] == 0


@pytest.mark.slow
def test_references_tell_claims_and_whether_they_hold(colift):
    code, told, errors = colift("references", "--people", "1", "--each", "1", "--jobs", "1")
    assert code in (0, 1)
    assert errors == ""
    for name in ("anticipate", "best known (trained)", "oracle", "two people", "Claims"):
        assert name in told
    assert ("NO" in told) == (code == 1)


@pytest.mark.parametrize(
    ("arguments", "told"),
    [
        (("references", "--seed", "5"), "seeds of new people start at 200000"),
        (("sweep", "--out", "sweep.txt"), "its suffix must be one of .png, .svg, .pdf"),
        (("learn", "anticipate", "--seed", "5", "--lifts", "1"), "seeds for learning are 100000"),
        (("run", "oracle"), "unknown policy 'oracle'"),
    ],
)
def test_what_a_user_gets_wrong_is_told_in_a_line(colift, arguments, told):
    pytest.importorskip("sklearn")
    code, _, errors = colift(*arguments)
    assert code == 2
    assert told in errors
    assert errors.count("\n") == 1


@pytest.mark.parametrize("arguments", [("references", "--people", "0"), ("ablate", "--each", "0")])
def test_numbers_of_people_and_lifts_are_positive(colift, arguments):
    pytest.importorskip("sklearn")
    code, _, errors = colift(*arguments)
    assert code == 2
    assert "greater than or equal to 1" in errors
