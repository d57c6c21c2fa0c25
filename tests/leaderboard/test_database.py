"""The tables: how they come to be, and that what was said stays said."""

import pytest
import sqlalchemy as sa
from alembic.autogenerate import compare_metadata
from alembic.migration import MigrationContext
from colift.agents.errors import InputError
from colift.leaderboard.board.board import Board
from colift.leaderboard.database.database import Database
from colift.leaderboard.database.migration import HEAD, migrate
from colift.leaderboard.database.schema import APPEND_ONLY, metadata
from colift.leaderboard.database.transactions import make_engine

from .rows import add


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


def test_a_database_of_a_later_colift_is_refused(engine):
    migrate(engine, "it")
    with engine.begin() as connection:
        connection.execute(sa.text("UPDATE alembic_version SET version_num = '9999'"))
    with pytest.raises(InputError, match="it has revision 9999, this colift knows up to"):
        migrate(engine, "it")


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
