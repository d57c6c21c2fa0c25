"""The practice season: made by the evaluation, written, read, adopted."""

import dataclasses
import hashlib
import json
from datetime import UTC, datetime

import pytest
from colift.agents.loading.policy_spec import PolicySpec
from colift.base.errors import InputError
from colift.base.registry import own_policies
from colift.benchmark.execution.runner import run_suite
from colift.benchmark.references.best_known import best_known_run
from colift.benchmark.references.catalogue import suite_references
from colift.benchmark.results.scores import ScoreTable
from colift.benchmark.suites.policies import made_for_suite
from colift.leaderboard.core.board import Board
from colift.leaderboard.evaluation.entrant import builtin_entrant
from colift.leaderboard.evaluation.evaluate import play_human_human, play_season_references
from colift.leaderboard.practice.season import SUITES, is_current, play_policy, practice_season
from colift.leaderboard.practice.season_import import DATA, PlayedSeason, practice_import
from colift.leaderboard.practice.shipped_scores import shipped_scores
from colift.leaderboard.replays.chosen import replays_of

SUITE = "tiny"
NOW = datetime(2026, 1, 2, tzinfo=UTC)


@pytest.fixture(scope="module")
def season(tiny_suite):
    return practice_season(SUITE)


@pytest.fixture(scope="module")
def played(season):
    human_human = play_human_human(season)
    return human_human, play_policy("copy", season, human_human, NOW)


@pytest.fixture(scope="module")
def shipped(season, played, tmp_path_factory):
    human_human, copy = played
    folder = tmp_path_factory.mktemp("data")
    made = PlayedSeason(
        suite=SUITE,
        suite_digest=season.suite.digest,
        began_at=NOW,
        human_human=human_human,
        references=play_season_references(season),
        played=(),
    )
    made.with_played(copy).write(folder)
    return folder


def test_an_own_policy_is_isolated_and_verified_as_anybodys(played, season):
    _, copy = played
    row = copy.entry.row
    assert row.verified
    assert row.name == copy.entry.name == "copy"
    assert row.submission == builtin_entrant("copy").digest
    assert row.commitment == hashlib.sha256(season.secret).hexdigest()
    assert (row.public.failed, row.hidden.failed) == (0, 0)
    assert len(copy.hidden_rmse_mm) == season.suite.size


def test_own_policies_have_digests_of_their_own():
    digests = {builtin_entrant(name).digest for name in own_policies("level")}
    assert len(digests) == len(own_policies("level"))
    with pytest.raises(InputError, match=r"no built-in policy 'nonesuch'.*blend"):
        builtin_entrant("nonesuch")


def test_what_is_written_is_read(shipped, played):
    human_human, copy = played
    found = PlayedSeason.read(SUITE, shipped)
    assert found.human_human == ScoreTable.read(human_human.plain())
    assert list(found.references) == ["best_known", "oracle"]
    assert found.began_at == NOW
    assert found.played == (copy,)
    assert PlayedSeason.read("paper-v1", shipped) is None


def test_equal_content_makes_equal_files(shipped, tmp_path):
    PlayedSeason.read(SUITE, shipped).write(tmp_path)
    for path in shipped.iterdir():
        assert (tmp_path / path.name).read_bytes() == path.read_bytes()


def test_what_is_no_longer_true_is_made_again(played, season):
    _, copy = played
    assert is_current(copy, season)
    row = copy.entry.row
    for changed in (
        dataclasses.replace(row, submission="0" * 64),
        dataclasses.replace(row, suite_digest="0" * 16),
        dataclasses.replace(row, versions={**row.versions, "numpy": "1.0"}),
        None,
    ):
        entry = dataclasses.replace(copy.entry, row=changed)
        assert not is_current(dataclasses.replace(copy, entry=entry), season)


def played_error(suite):
    """Return the error of the best known on lifts [mm], to the digits of a board."""
    return round(ScoreTable.of(best_known_run(suite)).mean, 2)


def test_a_board_adopts_what_is_shipped_with_references_on_the_lifts_of_its_rows(
    shipped, played, season, tmp_path
):
    _, copy = played
    board = Board.open(tmp_path / "board", SUITE)
    board.import_season(practice_import(SUITE, shipped))
    info = board.season_info()
    assert (info.name, info.current) == ("practice-tiny", True)
    assert board.season.secret == bytes.fromhex(info.revealed) == practice_season(SUITE).secret
    (standing,) = board.standings()
    assert standing.row == copy.entry.row
    known, error = board.references(), played_error(season.hidden)
    assert known["best_known"].rmse_mm.mean == error
    assert error != played_error(season.suite)
    assert standing.ranked
    bundle = board.bundle(info.name, copy.entry.submission)
    assert len(replays_of(bundle, "copy")) == 2
    groups = json.loads((bundle / "results.json").read_text())["groups"]
    assert [group["episodes"] for group in groups] == [2]
    assert board.new_season("2").secret != practice_season(SUITE).secret
    assert board.season_info().revealed is None
    board.close()


def test_a_shipped_season_can_be_one_to_look_at_only(shipped, tmp_path):
    board = Board.open(tmp_path / "board", SUITE)
    board.import_season(practice_import(SUITE, shipped, current=False))
    assert [(each.name, each.current) for each in board.seasons()] == [
        ("1", True),
        ("practice-tiny", False),
    ]
    board.close()


def test_what_is_shipped_for_other_rules_is_left_alone(shipped, tmp_path, monkeypatch):
    old = dataclasses.replace(PlayedSeason.read(SUITE, shipped), suite_digest="0" * 16)
    old.write(tmp_path)
    assert practice_import(SUITE, tmp_path) is None


@pytest.mark.parametrize("suite", SUITES)
def test_what_the_project_ships_is_of_its_suites_and_policies(suite):
    found = PlayedSeason.read(suite, DATA)
    season = practice_season(suite)
    assert found.suite_digest == season.suite.digest
    made = made_for_suite(season.suite)
    assert {each.entry.name for each in found.played} == set(made)
    assert all(each.entry.row.verified for each in found.played)
    assert found.references.keys() == suite_references(season.hidden).keys()
    assert all(each.entry.row.commitment == season.commitment for each in found.played)
    rows = {each.entry.name: each.entry.row.submission for each in found.played}
    changed = [name for name, digest in rows.items() if digest != builtin_entrant(name).digest]
    assert not changed, "colift practice --out leaderboard/data evaluates them again"


def test_the_public_scores_are_those_of_a_run(shipped, season):
    found = shipped_scores(season.suite, shipped)
    assert list(found) == ["copy"]
    run = run_suite(PolicySpec(text="copy"), season.suite)
    assert found["copy"].tolist() == [episode.scores["rmse_mm"] for episode in run.episodes]
    assert shipped_scores(season.suite.with_seeds(0, 1), shipped) == {}
    other = dataclasses.replace(season.suite, seeds=(7, 8))
    assert shipped_scores(other, shipped) == {}


def test_scores_of_a_policy_that_has_changed_are_not_public(shipped, season, tmp_path):
    changed = PlayedSeason.read(SUITE, shipped)
    (copy,) = changed.played
    entry = dataclasses.replace(copy.entry, submission="0" * 64)
    changed.with_played(dataclasses.replace(copy, entry=entry)).write(tmp_path)
    assert shipped_scores(season.suite, tmp_path) == {}
