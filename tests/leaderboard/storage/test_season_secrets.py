"""The stored baseline of a season: it is read as it was written, or refused as damaged."""

import json

import pytest
from colift.benchmark.results.scores import ScoreTable
from colift.leaderboard.storage.damage import DamagedError
from colift.leaderboard.storage.season_secrets import SeasonSecrets

KEPT = ScoreTable(
    strata=(("pause", "S1"), ("pause", "S2")),
    values={"rmse_mm": (5.0, 6.5)},
    means={"sparc": -2.5, "human_force_n": None},
)


@pytest.fixture
def secrets(tmp_path):
    made = SeasonSecrets(folder=tmp_path / "1")
    assert made.known_human_human() is None
    made.keep_human_human(KEPT)
    return made


def test_the_baseline_is_read_as_it_was_written(secrets):
    assert secrets.known_human_human().plain() == KEPT.plain()


def test_references_are_none_until_they_are_kept_and_refused_if_damaged(secrets):
    assert secrets.known_references() == {}
    secrets.keep_references({"oracle": KEPT})
    assert secrets.known_references()["oracle"].plain() == KEPT.plain()
    (secrets.folder / "references.json").write_text('{"oracle": {}}')
    with pytest.raises(DamagedError, match=r"references\.json is damaged.*season references"):
        secrets.known_references()


@pytest.mark.parametrize(
    ("change", "told"),
    [
        ({"strata": None}, r"Expected `array`, got `null` - at `\$.strata`"),
        ({"strata": [["pause"], ["pause", "S2"]]}, r"length 2, got 1 - at `\$.strata\[0\]`"),
        ({"strata": [["pause", "S1"]]}, "2 errors for the strata of 1 lifts"),
        ({"rmse_mm": [5.0, "6.5"]}, r"Expected `float`, got `str` - at `\$.rmse_mm\[1\]`"),
        ({"rmse_mm": [5.0, True]}, r"Expected `float`, got `bool` - at `\$.rmse_mm\[1\]`"),
        ({"rmse_mm": [5.0, float("nan")]}, "malformed"),
        ({"means": {"sparc": "none"}}, r"Expected `float \| null`, got `str`"),
        ({"means": []}, r"Expected `object`, got `array` - at `\$.means`"),
    ],
)
def test_a_damaged_one_is_named_with_what_would_be_right(secrets, change, told):
    path = secrets.folder / "human_human.json"
    path.write_text(json.dumps(KEPT.plain() | change))
    with pytest.raises(DamagedError, match=rf"human_human\.json is damaged \(.*{told}"):
        secrets.known_human_human()


@pytest.mark.parametrize("content", ["", "{", "[]", "null", '{"strata": 1e999}'])
def test_another_file_in_its_place_is_damaged(secrets, content):
    (secrets.folder / "human_human.json").write_text(content)
    with pytest.raises(DamagedError, match=r"human_human\.json is damaged"):
        secrets.known_human_human()
