"""The board's folder: what is where, who may read it, and that nothing in it changes."""

import json
import stat

import pytest
from colift.agents.errors import InputError
from colift.benchmark.hidden import commitment
from colift.benchmark.suite import make_suite
from colift.leaderboard.board import Board


@pytest.fixture
def board(tmp_path):
    return Board.open(tmp_path / "board", "quick-v1")


def mode(path):
    return stat.S_IMODE(path.stat().st_mode)


def test_a_new_board_commits_to_a_secret_that_only_its_owner_can_read(board):
    season = board.season
    assert season.suite == make_suite("quick-v1")
    told = json.loads((board.folder / "public/1/season.json").read_text())
    assert told == {
        "season": "1",
        "suite": "quick-v1",
        "suite_digest": season.suite.digest,
        "commitment": commitment(season.secret),
    }
    private = board.folder / "private"
    assert (mode(private), mode(private / "1/secret")) == (0o700, 0o600)


def test_a_new_board_is_on_the_standard_suite(tmp_path):
    assert Board.open(tmp_path / "board").season.suite.name == "standard-v1"


def test_a_board_is_found_again_with_the_same_secret(board):
    assert Board.open(board.folder).season == board.season
    assert Board.open(board.folder, "quick-v1").season == board.season


def test_another_suite_than_the_boards_is_refused(board):
    with pytest.raises(InputError, match=r"quick-v1, not of paper-v1"):
        Board.open(board.folder, "paper-v1")


def test_a_folder_of_other_things_does_not_become_a_board(tmp_path):
    (tmp_path / "thesis.tex").touch()
    with pytest.raises(InputError, match=r"thesis\.tex"):
        Board.open(tmp_path)
    assert [path.name for path in tmp_path.iterdir()] == ["thesis.tex"]


def test_a_file_does_not_become_a_board(tmp_path):
    (tmp_path / "file").touch()
    with pytest.raises(InputError, match="as a board"):
        Board.open(tmp_path / "file")


def test_two_boards_have_two_secrets(tmp_path):
    secrets = {Board.open(tmp_path / name, "quick-v1").season.secret for name in "ab"}
    assert len(secrets) == 2


def test_a_secret_that_others_can_read_is_refused(board):
    (board.folder / "private/1/secret").chmod(0o644)
    with pytest.raises(InputError, match="has mode 644"):
        board.season  # noqa: B018


def test_a_secret_that_was_exchanged_is_noticed(board):
    path = board.folder / "private/1/secret"
    path.write_text("ab" * 32)
    with pytest.raises(InputError, match="not the one that was committed to"):
        board.season  # noqa: B018


def test_a_season_of_other_rules_takes_nothing(board):
    path = board.folder / "public/1/season.json"
    told = json.loads(path.read_text())
    path.write_text(json.dumps({**told, "suite_digest": "0" * 16}))
    with pytest.raises(InputError, match="begin a new season"):
        board.season  # noqa: B018


def test_a_new_season_has_a_new_secret_and_leaves_the_old_one(board):
    first = board.season
    second = board.new_season("2027")
    assert board.season == second
    assert second.secret != first.secret
    assert second.suite == first.suite
    assert board.seasons() == ("1", "2027")
    assert board.vault("1").secret() == first.secret


@pytest.mark.parametrize(("name", "told"), [("1", "has had a season 1"), ("../x", "letters")])
def test_a_season_needs_a_new_name(board, name, told):
    with pytest.raises(InputError, match=told):
        board.new_season(name)


def test_a_submission_is_kept_by_its_content(board, write_submission):
    folder = write_submission()
    kept = board.keep(folder)
    assert kept.folder == board.folder / "submissions" / kept.contents.digest
    assert (kept.folder / "policy.py").read_bytes() == (folder / "policy.py").read_bytes()
    before = (kept.folder / "policy.py").stat()
    assert board.keep(folder).folder == kept.folder
    assert (kept.folder / "policy.py").stat() == before
    (folder / "policy.py").write_text("class Policy: ...")
    assert board.keep(folder).folder != kept.folder
    assert "gain" in (kept.folder / "policy.py").read_text()


def test_a_kept_submission_that_was_changed_is_not_evaluated(board, write_submission):
    folder = write_submission()
    kept = board.keep(folder)
    (kept.folder / "policy.py").write_text("class Policy: ...")
    with pytest.raises(InputError, match="has been changed"):
        board.keep(folder)


def test_what_is_no_submission_leaves_nothing_in_the_board(board, tmp_path):
    (tmp_path / "empty").mkdir()
    with pytest.raises(InputError, match=r"policy\.toml"):
        board.keep(tmp_path / "empty")
    assert list((board.folder / "submissions").iterdir()) == []


def test_a_submission_is_evaluated_by_one_process_at_a_time(board):
    with board.evaluating("a" * 64):
        with board.evaluating("b" * 64):
            pass
        with (
            pytest.raises(InputError, match="evaluated by another process"),
            board.evaluating("a" * 64),
        ):
            pass
    with board.evaluating("a" * 64) as files:
        assert files.is_dir()
    assert not files.exists()
