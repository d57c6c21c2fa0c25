"""A board: what is where, who may read it, its seasons, and what is kept of submissions."""

import stat

import pytest
from colift.agents.errors import InputError
from colift.benchmark.hidden import commitment
from colift.benchmark.suite import make_suite
from colift.leaderboard.board import Board

from .conftest import new_schema


def mode(path):
    return stat.S_IMODE(path.stat().st_mode)


def test_a_new_board_commits_to_a_secret_that_only_its_owner_can_read(board, clock):
    season = board.season
    assert season.suite == make_suite("quick-v1")
    (told,) = board.seasons()
    assert (told.name, told.suite, told.suite_digest) == ("1", "quick-v1", season.suite.digest)
    assert told.commitment == commitment(season.secret)
    assert (told.began_at, told.current, told.revealed) == (clock.now, True, None)
    private = board.folder / "private"
    assert (mode(private), mode(private / "1/secret")) == (0o700, 0o600)


def test_the_database_in_the_folder_is_for_its_owner_alone(tmp_path):
    board = Board.open(tmp_path / "board", "quick-v1")
    files = sorted(board.folder.glob("board.sqlite*"))
    assert len(files) == 3
    assert {mode(path) for path in files} == {0o600}
    board.close()


def test_a_new_board_is_on_the_standard_suite(open_board):
    assert open_board().season.suite.name == "standard-v1"


def test_a_board_is_found_again_with_the_same_secret(board, open_board):
    assert open_board().season == board.season
    assert open_board(suite="quick-v1").season == board.season


def test_another_suite_than_the_boards_is_refused(board, open_board):
    with pytest.raises(InputError, match=r"quick-v1, not of paper-v1"):
        open_board(suite="paper-v1")


def test_a_folder_of_other_things_does_not_become_a_board(tmp_path):
    (tmp_path / "thesis.tex").touch()
    with pytest.raises(InputError, match=r"thesis\.tex"):
        Board.open(tmp_path)
    assert [path.name for path in tmp_path.iterdir()] == ["thesis.tex"]


def test_a_file_does_not_become_a_board(tmp_path):
    (tmp_path / "file").touch()
    with pytest.raises(InputError, match="as a board"):
        Board.open(tmp_path / "file")


def test_a_board_of_another_layout_is_refused(tmp_path):
    (tmp_path / "board.json").write_text('{"format": 1}')
    with pytest.raises(InputError, match="format must be 2, is 1"):
        Board.open(tmp_path)


def test_two_boards_have_two_secrets(tmp_path):
    boards = [Board.open(tmp_path / name, "quick-v1") for name in "ab"]
    assert len({board.season.secret for board in boards}) == 2
    for board in boards:
        board.close()


def test_a_board_whose_tables_are_elsewhere_is_not_begun_anew(tmp_path, postgresql, monkeypatch):
    url = new_schema(postgresql)
    monkeypatch.setenv("COLIFT_DATABASE_URL", url)
    board = Board.open(tmp_path / "board", "quick-v1")
    board.close()
    with pytest.raises(InputError, match="private/1/secret is missing: is this the folder"):
        Board.open(tmp_path / "other")
    monkeypatch.delenv("COLIFT_DATABASE_URL")
    with pytest.raises(InputError, match="in PostgreSQL, not in SQLite: set COLIFT_DATABASE_URL"):
        Board.open(tmp_path / "board")
    Board.open(tmp_path / "third", "quick-v1").close()
    with pytest.raises(InputError, match="in SQLite, not in PostgreSQL: unset"):
        Board.open(tmp_path / "third", url=url)


def test_a_secret_that_others_can_read_is_refused(board, open_board):
    (board.folder / "private/1/secret").chmod(0o644)
    with pytest.raises(InputError, match="has mode 644"):
        board.season  # noqa: B018
    with pytest.raises(InputError, match="has mode 644"):
        open_board()


def test_a_secret_that_was_exchanged_is_noticed(board):
    path = board.folder / "private/1/secret"
    path.write_text("ab" * 32)
    with pytest.raises(InputError, match="not the one that was committed to"):
        board.season  # noqa: B018


def test_a_new_season_has_a_new_secret_and_leaves_the_old_one(board):
    first = board.season
    second = board.new_season("2027", who="Ada")
    assert board.season == second
    assert second.secret != first.secret
    assert second.suite == first.suite
    assert [(each.name, each.current) for each in board.seasons()] == [("1", False), ("2027", True)]
    assert board.season_of("1") == first
    begun = [(event.kind, event.season, event.who) for event in board.events()]
    assert begun == [("season", "1", "local"), ("season", "2027", "Ada")]


@pytest.mark.parametrize(("name", "told"), [("1", "has had a season 1"), ("../x", "letters")])
def test_a_season_needs_a_new_name(board, name, told):
    with pytest.raises(InputError, match=told):
        board.new_season(name)
    assert board.season.commitment == board.seasons()[0].commitment


def test_the_secret_of_a_season_is_published_when_nothing_can_be_won_by_it_any_more(board):
    secret = board.season.secret
    with pytest.raises(InputError, match="still takes submissions"):
        board.reveal("1", "Ada", "for all to check")
    board.new_season("2")
    board.reveal("1", "Ada", "for all to check")
    told = board.seasons()[0]
    assert bytes.fromhex(told.revealed) == secret
    assert commitment(bytes.fromhex(told.revealed)) == told.commitment
    assert board.events("1")[-1].why == "for all to check"


def test_an_unknown_season_is_named_with_those_that_there_are(board):
    board.new_season("2")
    for ask in (board.standings, board.ranking, board.team, board.season_of, board.season_info):
        with pytest.raises(InputError, match="no season '3'; it has 1, 2"):
            ask("3")


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
