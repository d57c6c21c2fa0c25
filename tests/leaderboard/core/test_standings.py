"""The table of a season: ranks, what is taken out of it, and what it costs to read."""

import dataclasses
from contextlib import contextmanager

import pytest
import sqlalchemy as sa
from colift.base.errors import InputError
from colift.benchmark.statistics import decisive
from colift.benchmark.suites.suite import make_suite
from colift.leaderboard.core.decisions import Decisions
from colift.leaderboard.core.seasons import ImportedSeason
from colift.leaderboard.core.standings import columns
from colift.leaderboard.records.season import PlayedEntry, Season, SeasonInfo

from ..conftest import SECRET
from ..rows import (
    add,
    digest,
    make_entry,
    make_errors,
    make_row,
    rescored,
    slow,
    unverified,
)


@contextmanager
def counted(board):
    """Yield the statements that the board's database meets meanwhile."""
    statements = []

    def note(connection, cursor, statement, *more):
        statements.append(statement)

    sa.event.listen(board.database.engine, "before_cursor_execute", note)
    try:
        yield statements
    finally:
        sa.event.remove(board.database.engine, "before_cursor_execute", note)


def ranks(board, season=None):
    return [(each.rank, each.row.name) for each in board.standings(season)]


def test_an_empty_board_has_an_empty_table(board):
    assert board.standings() == ()
    assert board.human_human() is None
    assert list(board.ranking().columns) == list(columns("standard-v1"))
    assert len(board.ranking()) == 0


def test_who_cannot_be_told_apart_shares_a_rank(board, clock):
    for name, mean in (("c", 20.0), ("a", 10.0), ("b", 10.0001)):
        add(board, name, mean)
        clock.turn(minutes=1)
    with board.database.writing() as connection:  # Lift by lift, b is now and then the better one.
        from colift.leaderboard.database.queries import record_errors

        errors = make_errors(10.0)
        record_errors(
            connection, "1", digest("b"), [e + 0.5 * (-1) ** i for i, e in enumerate(errors)]
        )
    assert ranks(board) == [(1, "a"), (1, "b"), (3, "c")]


def test_a_row_is_read_as_it_was_put_there(board, clock):
    entry = add(board, "mine", 12.0)
    (standing,) = board.standings("1")
    assert (standing.rank, standing.row, standing.at) == (1, make_row("mine", 12.0), clock.now)
    assert (standing.events, standing.submitter, standing.ranked) == ((), "Ada", True)
    assert board.entry("1", digest("mine")) == entry
    assert board.entry("1", "0" * 64) is None
    assert board.entry("2", digest("mine")) is None


def test_what_was_refused_has_an_entry_and_no_place_in_the_table(board):
    from colift.leaderboard.database.queries import record_entry

    entry = make_entry(board, "bad", refusal="it differs")
    with board.database.writing() as connection:
        record_entry(connection, entry, ())
    assert board.standings() == ()
    assert board.entry("1", digest("bad")) == entry
    with pytest.raises(InputError, match="no row of submission"):
        Decisions(board).withdraw("1", digest("bad"), "Ada", "mine")


@pytest.mark.parametrize("take_out", ["withdraw", "remove"])
def test_a_row_that_is_taken_out_stays_to_be_seen_with_the_reason(board, clock, take_out):
    for name, mean in (("a", 10.0), ("b", 15.0), ("c", 20.0)):
        add(board, name, mean)
    clock.turn(days=1)
    getattr(Decisions(board), take_out)("1", digest("a"), "Grace", "it read the clock")
    assert ranks(board) == [(1, "b"), (2, "c"), (0, "a")]
    (event,) = board.standings()[-1].events
    assert (event.at, event.who, event.why) == (clock.now, "Grace", "it read the clock")
    assert board.events(submission=digest("a")) == (event,)
    assert list(board.ranking()["name"]) == ["b", "c"]
    Decisions(board).reinstate("1", digest("a"), "Grace", "it did not")
    assert ranks(board) == [(1, "a"), (2, "b"), (3, "c")]
    assert len(board.standings()[0].events) == 2


def test_a_rescore_changes_the_table_and_not_the_entry(board):
    entry = add(board, "a", 10.0)
    add(board, "b", 15.0)
    right = rescored(entry.row, 18.0)
    Decisions(board).rescore("1", right, make_errors(18.0), "Grace", "a sensor was upside down")
    assert ranks(board) == [(1, "b"), (2, "a")]
    assert board.standings()[1].row == right
    assert board.entry("1", digest("a")) == entry
    assert board.standings()[1].events[0].kind == "rescore"


def test_what_is_not_real_time_is_ranked_apart_and_what_is_unverified_is_not_ranked(board):
    """However good they are."""
    add(board, "bad", 50.0)
    add(board, "good", 10.0)
    add(board, "slow", 5.0, change=slow)
    add(board, "slower", 20.0, change=slow)
    add(board, "free", 1.0, change=unverified)
    told = [(each.section, each.rank, each.row.name) for each in board.standings()]
    assert told == [
        ("ranking", 1, "good"),
        ("ranking", 2, "bad"),
        ("not real-time", 1, "slow"),
        ("not real-time", 2, "slower"),
        ("unverified", 0, "free"),
    ]
    assert [each.row.name for each in board.standings() if each.ranked] == ["good", "bad"]
    frame = board.ranking()
    assert list(frame["name"]) == ["good", "bad", "slow", "slower"]
    assert list(frame["section"]) == ["ranking"] * 2 + ["not real-time"] * 2
    assert board.standings() == board.standings()


def test_who_never_made_a_step_was_not_too_slow():
    row = make_row()
    public, hidden = (
        dataclasses.replace(each, real_time=None) for each in (row.public, row.hidden)
    )
    assert dataclasses.replace(row, public=public, hidden=hidden).real_time
    assert not slow(row).real_time
    too_slow = dataclasses.replace(row.public, real_time=False)
    assert not dataclasses.replace(row, public=too_slow).real_time


def test_lifts_that_are_too_few_to_tell_anybody_give_no_rank(board):
    """With five lifts the least p value is 1/16: who fails in all of them would be a first, too."""
    for name, mean in (("ruin", 250.0), ("good", 10.0)):
        add(board, name, mean, episodes=5)
    assert ranks(board) == [(0, "good"), (0, "ruin")]
    assert [each.section for each in board.standings()] == ["ranking"] * 2


@pytest.mark.parametrize(("people", "told"), [(1, False), (5, False), (6, True), (75, True)])
def test_whether_a_rank_can_be_told_follows_from_the_number_of_people(people, told):
    assert decisive(people) is told


def test_seasons_have_tables_of_their_own(board):
    add(board, "a", 10.0)
    board.new_season("2")
    add(board, "b", 9.0, season="2")
    assert (ranks(board), ranks(board, "1")) == ([(1, "b")], [(1, "a")])


def test_the_history_of_a_name_goes_over_seasons(board, clock):
    first = add(board, "mine", 10.0)
    add(board, "other", 10.0)
    board.new_season("2")
    clock.turn(days=30)
    second = add(board, "mine", 9.0, season="2")
    assert board.entries_of("mine") == (first, second)
    assert board.entries_of("nobody") == ()


def test_the_data_frame_has_the_rows_in_the_order_of_the_table(board):
    add(board, "b", 15.0)
    add(board, "a", 10.0)
    frame = board.ranking("1")
    assert list(frame["name"]) == ["a", "b"]
    assert list(frame["rank"]) == [1, 2]
    assert list(frame["rmse_mm"]) == [10.0, 15.0]
    assert frame["authors"][0] == "Ada Lovelace, Grace Höpper"


def test_the_number_of_queries_does_not_grow_with_the_entries(board):
    counts = []
    for start, stop in ((0, 2), (2, 40)):
        for number in range(start, stop):
            add(board, f"policy {number}", 10.0 + number)
        board.standings()
        with counted(board) as statements:
            assert len(board.standings()) == stop
        counts.append(len(statements))
    assert counts[0] == counts[1]


@pytest.mark.slow
def test_the_last_of_very_many_can_still_be_told_from_the_first(board):
    for number in range(600):
        add(board, f"policy {number}", 10.0 if number else 5.0, episodes=60)
    first, second, *_ = ranks(board)
    assert (first, second[0]) == ((1, "policy 0"), 2)


def test_ranks_are_computed_once_for_each_state_of_the_board(board, monkeypatch):
    from colift.leaderboard.core import ranks as module

    tested, calls = module.all_pairs, []
    monkeypatch.setattr(
        module, "all_pairs", lambda errors, people: calls.append(1) or tested(errors, people)
    )
    add(board, "a", 10.0)
    assert board.standings() == board.standings()
    assert len(calls) == 1
    add(board, "b", 12.0)
    board.standings()
    assert len(calls) == 2


def practice(board, human_human, current=False, files=()):
    season = Season(name="practice", suite=make_suite("quick-v1"), secret=SECRET)
    info = SeasonInfo(
        name="practice",
        suite=season.suite.name,
        suite_digest=season.suite.digest,
        commitment=season.commitment,
        began_at=board.clock(),
        current=current,
        revealed=SECRET.hex(),
    )
    entries = [
        PlayedEntry(
            entry=make_entry(board, name, mean, "practice"),
            hidden_rmse_mm=make_errors(mean),
            files=dict(files),
        )
        for name, mean in (("blend", 16.0), ("proactive", 14.0))
    ]
    return ImportedSeason(info=info, entries=entries, human_human=human_human)


def test_a_season_from_elsewhere_is_taken_over_with_its_rows(board, human_human):
    told = practice(board, human_human, files={"results.json": b"{}"})
    board.import_season(told)
    board.import_season(told)
    assert ranks(board, "practice") == [(1, "proactive"), (2, "blend")]
    assert [(each.name, each.current) for each in board.seasons()] == [
        ("1", True),
        ("practice", False),
    ]
    assert board.seasons()[1] == told.info
    assert board.human_human("practice").rmse_mm.mean == round(human_human.mean, 2)
    assert (board.bundle("practice", digest("blend")) / "results.json").read_text() == "{}"
    assert board.bundle("1", digest("blend")) is None


def test_a_season_from_elsewhere_may_take_submissions(board, human_human):
    board.import_season(practice(board, human_human, current=True))
    assert board.season.secret == SECRET
    board.new_season("2")
    assert board.season.secret != SECRET


def test_a_season_from_elsewhere_must_have_the_secret_that_it_is_committed_to(board, human_human):
    told = practice(board, human_human)
    import dataclasses

    wrong = dataclasses.replace(told.info, commitment="0" * 64)
    with pytest.raises(InputError, match="practice: its secret does not match"):
        board.import_season(dataclasses.replace(told, info=wrong))
    assert len(board.seasons()) == 1
