"""A board: what is where, who may read it, its seasons, and what is kept of submissions."""

import dataclasses
import os
import shutil
import stat
import threading

import pytest
from colift.agents.submissions import folder as reading
from colift.base.errors import InputError
from colift.benchmark.suites.hidden import commitment
from colift.benchmark.suites.suite import make_suite
from colift.leaderboard.core.board import Board
from colift.leaderboard.queue import Queue, WorkerQueue
from colift.leaderboard.queue import work as work_module
from colift.leaderboard.service.uploads import remove_orphans
from colift.leaderboard.storage.staging import PREFIX, remove_abandoned, staging

from ..conftest import new_schema
from ..rows import make_entry


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


def test_a_new_board_is_on_the_leading_suite(open_board):
    assert open_board().season.suite.name == "robust-v1"


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


@pytest.mark.parametrize("content", ["", "{", "[]", "7", '{"format": NaN}', '{"format": 1e999}'])
def test_a_board_whose_mark_is_damaged_is_refused(tmp_path, content):
    (tmp_path / "board.json").write_text(content)
    with pytest.raises(InputError, match=r"board\.json cannot be read: "):
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
    with pytest.raises(InputError, match="does not match its commitment"):
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


@pytest.mark.parametrize(("name", "told"), [("1", "already has a season 1"), ("../x", "letters")])
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
    for ask in (
        board.standings,
        board.ranking,
        board.human_human,
        board.season_of,
        board.season_info,
    ):
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


def test_a_submission_is_read_once_on_its_way_into_the_board(board, write_submission, monkeypatch):
    read, walk = [], reading._walk

    def counted(place, *more):
        read.append(place)
        return walk(place, *more)

    mine = write_submission()
    monkeypatch.setattr(reading, "_walk", counted)
    kept = board.keep(mine)
    assert read == [mine]
    assert board.store.submission(kept.contents.digest) == kept


@pytest.mark.parametrize("damage", ["cut short", "gone", "link", "all gone"])
def test_a_damaged_copy_is_not_evaluated_and_replaced_by_the_same_submission(
    board, write_submission, damage
):
    folder = write_submission()
    kept = board.keep(folder)
    digest, policy = kept.contents.digest, kept.folder / "policy.py"
    if damage == "cut short":
        os.truncate(policy, 10)
    elif damage == "all gone":
        shutil.rmtree(kept.folder)
    else:
        policy.unlink()
    if damage == "link":
        policy.symlink_to(folder / "policy.py")
    with pytest.raises(InputError, match="not as it was submitted: submit the same") as caught:
        board.store.submission(digest)
    assert str(board.folder) not in str(caught.value)
    assert board.keep(folder).contents.digest == digest
    assert board.store.submission(digest).folder == kept.folder
    assert [path.name for path in (board.folder / "submissions").iterdir()] == [digest]


def test_all_files_are_on_the_disk_before_a_job_or_a_row_is(board, write_submission, monkeypatch):
    """As far as the system says so when it is asked to."""
    synced, moments = set(), []
    fsync = os.fsync
    work = WorkerQueue(board)

    def note(handle):
        fsync(handle)
        synced.add(os.fstat(handle).st_ino)

    monkeypatch.setattr(os, "fsync", note)

    def unsynced(*paths):
        return [path for path in paths if path.stat().st_ino not in synced]

    def missing(folder):
        return unsynced(folder, *folder.rglob("*"))

    with board.store.staging() as place:
        shutil.copytree(write_submission(), place / "files")
        incoming = board.store.incoming(place / "files")

        def placed():
            incoming.place()
            moments.append(missing(incoming.target))
            moments.append(unsynced(incoming.target.parent))

        job = Queue(board).enqueue(incoming.submission, "Ada", placed)
    bundle = board.folder / "made"
    (bundle / "inner").mkdir(parents=True)
    (bundle / "inner" / "traces").write_bytes(b"x")
    made = make_entry(board, job.name)
    entry = dataclasses.replace(made, submission=job.submission)
    record = work_module.record_entry

    def recorded(*arguments):
        folder = board.store.bundle("1", job.submission)
        moments.append(missing(folder))
        moments.append(unsynced(*folder.parents[:4]))
        record(*arguments)

    monkeypatch.setattr(work_module, "record_entry", recorded)
    work.finish(work.claim("one"), entry, bundle=bundle)
    assert moments == [[]] * 4


@pytest.mark.parametrize(
    ("text", "shown"),
    [
        ("cannot read {folder}/submissions/x/policy.py", "cannot read policy.py"),
        ("[Errno 28] No space left: '/srv/boards of us/x.txt'", None),
        ('File "/usr/lib/python3.11/json.py", line 3', 'File "json.py", line 3'),
        ("see https://example.org/a/b/c", "see https://example.org/a/b/c"),
        ("0.3 m/s/s at /tmp", "0.3 m/s/s at /tmp"),
    ],
)
def test_folders_of_this_machine_are_not_told(board, text, shown):
    told = board.store.placeless(text.format(folder=board.folder))
    assert shown is None or told == shown
    assert str(board.folder) not in told
    assert "/srv/" not in told


def test_what_no_job_is_about_is_removed_when_it_is_old(board, write_submission):
    kept = [board.keep(write_submission(f"class Policy: ...  # {i}", name=f"p{i}")) for i in "123"]
    Queue(board).enqueue(kept[0], "Ada")
    for each in kept[:2]:
        os.utime(each.folder, (1e9, 1e9))
    with board.store.staging() as working:
        (working / "files").mkdir()
        (board.folder / "submissions" / f"{PREFIX}killed").mkdir()
        remove_orphans(board)
        there = {path.name for path in (board.folder / "submissions").iterdir()}
        assert there == {working.name, kept[0].contents.digest, kept[2].contents.digest}
        assert (working / "files").is_dir()


def test_a_folder_that_is_swept_while_it_is_made_is_made_again(tmp_path):
    """Sweeps that never end, and folders that must be whole as long as they are used."""
    done = threading.Event()

    def sweep_on():
        while not done.is_set():
            remove_abandoned(tmp_path)

    thread = threading.Thread(target=sweep_on)
    thread.start()
    try:
        for _ in range(200):
            with staging(tmp_path) as place:
                (place / "files").mkdir()
                assert (place / "lock").exists()
    finally:
        done.set()
        thread.join()
    assert list(tmp_path.iterdir()) == []


def test_what_is_no_submission_leaves_nothing_in_the_board(board, tmp_path):
    (tmp_path / "empty").mkdir()
    with pytest.raises(InputError, match="is empty: it holds no file of a submission"):
        board.keep(tmp_path / "empty")
    assert list((board.folder / "submissions").iterdir()) == []
