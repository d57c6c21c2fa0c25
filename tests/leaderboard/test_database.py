"""The tables: how they come to be, and that what was said stays said."""

import signal
import sqlite3
import threading
from pathlib import Path

import pytest
import sqlalchemy as sa
from alembic.autogenerate import compare_metadata
from alembic.migration import MigrationContext
from colift.base.errors import InputError
from colift.leaderboard import database as tables
from colift.leaderboard.core.board import Board
from colift.leaderboard.core.tokens import Tokens
from colift.leaderboard.database.connection import Database
from colift.leaderboard.database.migration import HEAD, migrate
from colift.leaderboard.database.queries import read_entries, read_error_numbers, read_errors
from colift.leaderboard.database.schema import APPEND_ONLY, metadata
from colift.leaderboard.database.transactions import make_engine, reading, writing
from colift.leaderboard.queue import Queue, WorkerQueue

from .revisions.make import HERE, stored
from .rows import add, digest, make_errors


@pytest.fixture
def engine(tmp_path, database):
    """Yield the engine of an empty database."""
    url = (database or f"sqlite:///{tmp_path}/board.sqlite").replace("sql://", "sql+psycopg://")
    engine = make_engine(sa.make_url(url))
    yield engine
    engine.dispose()


def differences(engine):
    with engine.connect() as connection:
        return compare_metadata(MigrationContext.configure(connection), metadata)


def revision(engine):
    with engine.connect() as connection:
        return connection.scalar(sa.text("SELECT version_num FROM alembic_version"))


def test_an_empty_database_gets_the_tables_that_the_schema_says(engine):
    migrate(engine, "it")
    assert revision(engine) == HEAD
    assert [each for each in differences(engine) if "alembic_version" not in str(each)] == []


def test_a_migration_that_fails_leaves_nothing(engine, monkeypatch):
    monkeypatch.setattr("colift.leaderboard.database.migration.protect", None)
    with pytest.raises(TypeError):
        migrate(engine, "it")
    monkeypatch.undo()
    assert sa.inspect(engine).get_table_names() == []
    migrate(engine, "it")
    assert revision(engine) == HEAD


VERSIONS = Path(tables.__file__).parent / "migrations" / "versions"
REVISIONS = sorted(path.name[:4] for path in VERSIONS.glob("0*.py"))


@pytest.fixture
def restored(engine):
    """Return what fills the empty database with the stored one of a revision."""

    def fill(revision, change=("", "")):
        text = stored(revision, engine.dialect.name).replace(*change)
        if engine.dialect.name == "sqlite":
            with sqlite3.connect(engine.url.database) as connection:
                connection.executescript(text)
        else:
            with engine.begin() as connection:
                connection.connection.driver_connection.execute(text)
        return engine

    return fill


@pytest.mark.parametrize("revision", REVISIONS)
def test_a_database_of_each_revision_becomes_one_of_the_last_and_loses_nothing(
    restored, revision, tmp_path
):
    """A new revision needs a stored database: python -m tests.leaderboard.revisions.make"""
    engine = restored(revision)
    migrate(engine, "it")
    assert [each for each in differences(engine) if "alembic_version" not in str(each)] == []
    board = Board(tmp_path, Database(engine))
    with board.database.reading() as connection:
        mine, yours = read_entries(connection)
        numbers = read_error_numbers(connection, "1")
        errors = read_errors(connection, "1", numbers)
    assert (mine.name, mine.row.hidden.rmse_mm.mean, yours.submitter) == ("mine", 10.0, "Ada")
    assert errors[digest("mine")] == pytest.approx(make_errors(10.0))
    assert [each.kind for each in board.events()] == ["season", "removal"]
    assert [each.name for each in Tokens(board).all()] == ["ada"]
    queue, work = Queue(board), WorkerQueue(board)
    assert {job.state for job in queue.jobs()} == {"queued", "running"}
    assert "has been seen since 2026-11-" in queue.unattended(queue.jobs("queued")[0])
    taken = {work.claim("new").name for _ in range(2)}
    assert taken == {"first", "second"}
    assert queue.unattended(queue.jobs()[0]) is None
    add(board, "new", 11.0)  # Sequences of numbers go on, too.
    with pytest.raises(sa.exc.DBAPIError), board.database.writing() as connection:
        connection.execute(sa.text("DELETE FROM entries"))


def test_every_revision_has_a_stored_database_that_really_is_of_it(restored):
    assert REVISIONS[-1] == HEAD
    for kind in ("sqlite", "postgresql"):
        assert sorted(path.name[:4] for path in HERE.glob(f"*_{kind}.sql")) == REVISIONS
    engine = restored(REVISIONS[0])
    assert revision(engine) == REVISIONS[0]
    assert "workers" not in sa.inspect(engine).get_table_names()


@pytest.mark.parametrize(
    ("number", "told"),
    [
        ("9999", f"revision 9999, this colift knows up to {HEAD}: a later colift made it"),
        ("0002", "revision 0002, of a development version before the first release"),
        ("0003", "revision 0003, of a development version before the first release"),
    ],
)
def test_tables_that_this_colift_does_not_know_are_refused_and_stay(restored, number, told):
    engine = restored("0001", ("'0001'", f"'{number}'"))
    with pytest.raises(InputError, match=told):
        migrate(engine, "it")
    assert revision(engine) == number


def test_tables_that_only_have_the_number_of_a_revision_are_refused_and_stay(restored):
    """As of a development version, whose jobs had no size."""
    engine = restored("0001")
    with engine.begin() as connection:
        connection.execute(sa.text("ALTER TABLE jobs DROP COLUMN size"))
    with pytest.raises(InputError, match=r"it lacks jobs\.size: its tables are those of a develop"):
        migrate(engine, "it")
    assert revision(engine) == "0001"
    assert "workers" not in sa.inspect(engine).get_table_names()


@pytest.mark.parametrize("table", APPEND_ONLY)
@pytest.mark.parametrize("what", ["UPDATE {0} SET season_or_name = 'x'", "DELETE FROM {0}"])
def test_what_was_said_cannot_be_changed_by_anybody(board, table, what):
    add(board, "mine", 10.0)
    statement = what.format(table).replace(
        "season_or_name", "name" if table == "seasons" else "season"
    )
    before = contents(board, table)
    assert before
    refused = pytest.raises(sa.exc.DBAPIError, match=f"{table} is append-only")
    with refused, board.database.writing() as connection:
        connection.execute(sa.text(statement))
    assert contents(board, table) == before


def test_what_was_said_cannot_be_replaced_or_truncated(board):
    add(board, "mine", 10.0)
    statement = "TRUNCATE entries"
    if board.database.engine.dialect.name == "sqlite":
        statement = "REPLACE INTO entries SELECT * FROM entries"
    refused = pytest.raises(sa.exc.DBAPIError, match="entries is append-only")
    with refused, board.database.writing() as connection:
        connection.execute(sa.text(statement))


def contents(board, table):
    with board.database.reading() as connection:
        return connection.execute(sa.select(metadata.tables[table])).all()


def add_a_token_and_be_interrupted(board):
    token = {"name": "x", "sha256": "y", "added_at": board.clock()}
    with board.database.writing() as connection:
        connection.execute(metadata.tables["tokens"].insert().values(**token))
        raise KeyboardInterrupt


def test_a_change_that_fails_leaves_nothing(board):
    before = contents(board, "events")
    with pytest.raises(KeyboardInterrupt):
        add_a_token_and_be_interrupted(board)
    assert contents(board, "tokens") == []
    assert contents(board, "events") == before


@pytest.mark.parametrize(
    ("url", "told"),
    [
        ("mysql://here/x", "begins with mysql://; it must be postgresql://"),
        ("nonsense", "is not the URL of a database"),
        ("postgresql://ada:geheim@127.0.0.1:1/x", "cannot be opened"),
    ],
)
def test_a_database_that_is_none_is_told_without_its_password(tmp_path, url, told):
    with pytest.raises(InputError, match=told) as caught:
        Database.open(tmp_path, url)
    assert "geheim" not in str(caught.value)


def test_a_file_that_is_no_database_is_told(tmp_path):
    (tmp_path / "board.sqlite").write_text("no database at all, whatever its name says" * 100)
    with pytest.raises(InputError, match="cannot be opened: file is not a database"):
        Board.open(tmp_path)


@pytest.mark.parametrize("transaction", [reading, writing])
def test_an_interrupt_that_a_driver_turns_into_an_error_of_its_own_stays_one(engine, transaction):
    """As psycopg does if it is interrupted while it looks whether a connection still works."""
    broken = []

    def reset(connection, record, proxy):
        if broken:
            try:
                raise KeyboardInterrupt
            finally:
                raise engine.dialect.dbapi.ProgrammingError("the connection is in use")

    sa.event.listen(engine, "checkout", reset)
    with transaction(engine) as connection:
        assert connection.scalar(sa.text("SELECT 1")) == 1
    broken.append(True)
    with pytest.raises(KeyboardInterrupt), transaction(engine):
        pass
    broken.clear()
    with transaction(engine) as connection:
        assert connection.scalar(sa.text("SELECT 1")) == 1


@pytest.mark.parametrize("transaction", [reading, writing])
def test_an_error_stays_what_it_is(engine, transaction):
    with pytest.raises(sa.exc.DBAPIError), transaction(engine) as connection:
        connection.execute(sa.text("SELECT nothing FROM nowhere"))


@pytest.mark.parametrize("transaction", [reading, writing])
def test_an_error_of_a_cleanup_after_an_interrupt_stays_one(engine, transaction):
    try:
        raise KeyboardInterrupt
    except KeyboardInterrupt:
        with pytest.raises(sa.exc.DBAPIError), transaction(engine) as connection:
            connection.execute(sa.text("SELECT nothing FROM nowhere"))


@pytest.mark.parametrize("transaction", [reading, writing])
def test_an_interrupt_amid_a_query_leaves_a_database_that_works(postgresql, transaction):
    engine = make_engine(sa.make_url(postgresql.replace("sql://", "sql+psycopg://")))
    interrupt = threading.Timer(0.3, signal.pthread_kill, (threading.get_ident(), signal.SIGINT))
    usual = signal.signal(signal.SIGINT, signal.default_int_handler)
    try:
        interrupt.start()
        with pytest.raises(KeyboardInterrupt), transaction(engine) as connection:
            connection.execute(sa.text("SELECT pg_sleep(30)"))
        with transaction(engine) as connection:
            assert connection.scalar(sa.text("SELECT 1")) == 1
    finally:
        signal.signal(signal.SIGINT, usual)
        engine.dispose()
