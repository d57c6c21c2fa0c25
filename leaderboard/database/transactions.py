"""Transactions that mean the same in SQLite and in PostgreSQL."""

import sys
from collections.abc import Iterator
from contextlib import contextmanager
from datetime import UTC, datetime
from typing import Any, Final

import msgspec
import sqlalchemy as sa

WAIT_S: Final = 60
"""Longest time that a writer waits for the others, and that one may be idle [s]."""

CONNECT_S: Final = 5
"""Longest time that connecting to a server may take [s]."""

_LOCK: Final = 0x636F6C696674
"""Key of the lock that PostgreSQL's writers hold."""

_SQLITE: Final = (
    "PRAGMA journal_mode = WAL",
    "PRAGMA synchronous = FULL",
    "PRAGMA foreign_keys = ON",
    "PRAGMA recursive_triggers = ON",
)

_POSTGRESQL: Final = (
    f"SET lock_timeout = '{WAIT_S}s'",
    # A writer that was frozen, or whose machine is gone, must not hold up all others.
    f"SET idle_in_transaction_session_timeout = '{WAIT_S}s'",
)


def make_engine(url: sa.URL) -> sa.Engine:
    """Return the engine of a database, without connecting to it."""
    if url.get_backend_name() == "sqlite":
        engine = sa.create_engine(
            url, connect_args={"timeout": WAIT_S}, json_deserializer=msgspec.json.decode
        )
        sa.event.listen(engine, "connect", _prepare_sqlite)
        sa.event.listen(engine, "begin", _begin_sqlite)
    else:
        engine = sa.create_engine(
            url,
            pool_pre_ping=True,
            connect_args={"connect_timeout": CONNECT_S},
            json_deserializer=msgspec.json.decode,
        )
        sa.event.listen(engine, "connect", _prepare_postgresql)
    return engine


@contextmanager
def _interrupts_shown() -> Iterator[None]:
    """Raise an interrupt as such, where a driver raises an error of its own in its place.

    It does so if it is interrupted amid a query and then resets the connection. The error would
    be taken for one of the database or of the machine, and the work would go on. An error of a
    transaction that cleans up after an interrupt stays an error.
    """
    handled = sys.exc_info()[1]
    try:
        yield
    except Exception as error:
        cause: BaseException | None = error
        while cause is not None and cause is not handled:
            if isinstance(cause, KeyboardInterrupt):
                raise KeyboardInterrupt from error
            cause = cause.__cause__ or cause.__context__
        raise


@contextmanager
def reading(engine: sa.Engine) -> Iterator[sa.Connection]:
    """Yield a connection that sees one state of the database."""
    with _interrupts_shown(), engine.connect() as connection:
        if connection.dialect.name == "postgresql":
            connection.execution_options(isolation_level="REPEATABLE READ")
        with connection.begin():
            yield connection


@contextmanager
def writing(engine: sa.Engine) -> Iterator[sa.Connection]:
    """Yield a connection whose changes are made as a whole or not at all, one at a time."""
    with (
        _interrupts_shown(),
        engine.connect().execution_options(writing=True) as connection,
        connection.begin(),
    ):
        if connection.dialect.name == "postgresql":
            connection.exec_driver_sql(f"SELECT pg_advisory_xact_lock({_LOCK})")
        yield connection


def database_time(connection: sa.Connection) -> datetime:
    """Return the time of the database: one clock for all that use it.

    It is the time of this moment, not of the transaction's beginning, which may have waited.
    """
    if connection.dialect.name == "postgresql":
        now: datetime = connection.exec_driver_sql("SELECT clock_timestamp()").scalar_one()
        return now.astimezone(UTC)
    text: str = connection.exec_driver_sql(
        "SELECT strftime('%Y-%m-%d %H:%M:%f', 'now')"
    ).scalar_one()
    return datetime.fromisoformat(text).replace(tzinfo=UTC)


def _prepare_sqlite(connection: Any, record: object) -> None:
    connection.isolation_level = None  # Otherwise the driver begins transactions by itself.
    for pragma in _SQLITE:
        connection.execute(pragma).close()


def _begin_sqlite(connection: sa.Connection) -> None:
    # A deferred transaction would let another process write between its read and its write.
    wants = connection.get_execution_options().get("writing")
    connection.exec_driver_sql("BEGIN IMMEDIATE" if wants else "BEGIN")


def _prepare_postgresql(connection: Any, record: object) -> None:
    for setting in _POSTGRESQL:
        connection.execute(setting).close()
    connection.commit()
