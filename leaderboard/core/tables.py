"""The tables of a board's seasons, kept in memory.

The record is append-only, so only what was added since the last look is read. A table is built once
for each change, however often it is read, and reading never waits for ranks.
"""

import functools
import math
import threading
from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace

import sqlalchemy as sa
from colift.benchmark.statistics import Units
from colift.leaderboard.core.ranks import Ranks, Scored, compute_ranks, fingerprint, read_ranks
from colift.leaderboard.core.standings import ORDER, RANKED, RankedRow, Section, row_now, section
from colift.leaderboard.database.connection import Database
from colift.leaderboard.database.queries import read_entries, read_error_numbers, read_events
from colift.leaderboard.database.schema import entries, events, hidden_errors
from colift.leaderboard.records.row import BoardRow
from colift.leaderboard.records.season import BoardEntry, Event
from colift.leaderboard.storage.store import Store


@dataclass(frozen=True, eq=False)
class Table:
    """The rows of a season, best first; those out of the ranking are at the end."""

    rows: tuple[RankedRow, ...] = ()
    scored: Scored = field(default_factory=dict)
    """What the ranks of these rows follow from."""
    current: bool = True
    """Whether the ranks follow from these rows. Otherwise they are those before the last change,
    and the next ones are being computed, or will be."""

    @functools.cached_property
    def sections(self) -> Mapping[Section, tuple[RankedRow, ...]]:
        """The rows of each section."""
        found: dict[Section, list[RankedRow]] = {name: [] for name in ORDER}
        for each in self.rows:
            found[each.section].append(each)
        return {name: tuple(rows) for name, rows in found.items()}

    @property
    def ranking(self) -> tuple[RankedRow, ...]:
        """The rows of the ranking."""
        return self.sections["ranking"]

    @functools.cached_property
    def sizes(self) -> Mapping[int, int]:
        """Number of policies of each rank of the ranking."""
        return Counter(each.rank for each in self.ranking)

    @functools.cached_property
    def by_digest(self) -> Mapping[str, RankedRow]:
        """The rows, by the digest of their submission."""
        return {each.row.submission: each for each in self.rows}


@dataclass(frozen=True)
class _Record:
    """What has been read of a season."""

    entries: dict[str, BoardEntry] = field(default_factory=dict)
    """Its entries with a row, oldest first."""
    events: dict[str, tuple[Event, ...]] = field(default_factory=dict)
    """The events of each submission."""
    rows: dict[str, BoardRow] = field(default_factory=dict)
    """The rows, or those of their last rescore."""
    numbers: dict[str, int] = field(default_factory=dict)
    """Number of the valid errors of each submission."""
    read: tuple[int, ...] = (0, 0, 0)
    """Last numbers of all entries, events and errors."""
    ranks: Ranks = field(default_factory=Ranks)
    table: Table = field(default_factory=Table)


class Tables:
    """The tables of the seasons of a board.

    Parameters
    ----------
    database
        The board's.
    store
        Its files.
    """

    def __init__(self, database: Database, store: Store) -> None:
        self._database, self._store = database, store
        self._records: dict[str, _Record] = {}
        self._ranks: dict[str, Ranks] = {}
        self._lock = threading.Lock()

    @property
    def seasons(self) -> tuple[str, ...]:
        """The seasons whose tables have been read."""
        return tuple(self._records)

    def read(self, season: str) -> Table:
        """Return the table of a season as it is now, with the ranks that were computed last."""
        with self._lock:
            known = self._records.get(season, _Record())
            with self._database.reading() as connection:
                record = _read_on(connection, season, known)
                ranks = self.ranks(connection, season)
            if record is not known or ranks is not known.ranks:
                record = replace(record, ranks=ranks, table=_table(record, ranks))
            self._records[season] = record
            return record.table

    def ranked(self, season: str) -> Table:
        """Return the table of a season with its own ranks; compute them if they are missing."""
        while not (table := self.read(season)).current:
            with self._store.ranking():
                table = self.read(season)
                if not table.current:  # Another process may have done it.
                    compute_ranks(self._database, season, table.scored, self._people(season))
        return table

    def _people(self, season: str) -> Units | None:
        """Return the people of a season's hidden lifts, once its human-human baseline is known."""
        known = self._store.secrets(season).known_human_human()
        return None if known is None else known.units

    def row(self, season: str, submission: str) -> RankedRow | None:
        """Return a row with its present rank; None if there is none. This builds no table."""
        return next(iter(self.rows(season, entries.c.submission == submission)), None)

    def last_ranks(self, season: str) -> Ranks:
        """Return the ranks of a season that were computed last."""
        with self._database.reading() as connection:
            return self.ranks(connection, season)

    def newest(self, season: str, most: int) -> tuple[RankedRow, ...]:
        """Return the newest rows of a season, as :meth:`row`."""
        last = (
            sa.select(entries.c.number)
            .where(entries.c.season == season, entries.c.refusal.is_(None))
            .order_by(entries.c.at.desc(), entries.c.number.desc())
            .limit(most)
        )
        found = self.rows(season, entries.c.number.in_(last))
        return tuple(sorted(found, key=lambda each: each.at, reverse=True))

    def rows(self, season: str, *conditions: sa.ColumnElement[bool]) -> tuple[RankedRow, ...]:
        """Return the rows of those entries for which all conditions hold, as :meth:`row`."""
        with self._database.reading() as connection:
            this = (entries.c.season == season, entries.c.refusal.is_(None))
            found = read_entries(connection, *this, *conditions)
            mine = [each.submission for each in found]
            told = _by_submission(
                read_events(connection, events.c.season == season, events.c.submission.in_(mine))
            )
            numbers = read_error_numbers(connection, season, hidden_errors.c.submission.in_(mine))
            ranks = self.ranks(connection, season)
        return tuple(
            _ranked_row(
                each,
                row_now(each.row, told.get(each.submission, ())),
                told.get(each.submission, ()),
                numbers.get(each.submission),
                ranks,
            )
            for each in found
            if each.row is not None
        )

    def ranks(self, connection: sa.Connection, season: str) -> Ranks:
        """Return the ranks of a season that were computed last."""
        found = read_ranks(connection, season, self._ranks.get(season, Ranks()))
        self._ranks[season] = found
        return found


def _read_on(connection: sa.Connection, season: str, known: _Record) -> _Record:
    """Return the record with what was added since; the same if that is nothing of this season."""
    tables = (entries, events, hidden_errors)
    last = tuple(connection.scalar(sa.select(sa.func.max(each.c.number))) or 0 for each in tables)
    if last == known.read:
        return known
    new = [
        (each.c.season == season) & (each.c.number > number)
        for each, number in zip(tables, known.read, strict=True)
    ]
    added = read_entries(connection, new[0], entries.c.refusal.is_(None))
    told = _by_submission(read_events(connection, new[1], events.c.submission.is_not(None)))
    numbers = read_error_numbers(connection, season, new[2])
    histories = {each: (*known.events.get(each, ()), *more) for each, more in told.items()}
    all_entries = known.entries | {each.submission: each for each in added}
    all_events = known.events | histories
    changed = {each.submission for each in added} | set(told)
    return replace(
        known,
        entries=all_entries,
        events=all_events,
        rows=known.rows
        | {
            each: row_now(entry.row, all_events.get(each, ()))
            for each in changed
            if (entry := all_entries.get(each)) is not None and entry.row is not None
        },
        numbers=known.numbers | numbers,
        read=last,
    )


def _by_submission(found: Sequence[Event]) -> dict[str, tuple[Event, ...]]:
    of: dict[str, tuple[Event, ...]] = {}
    for event in found:
        if event.submission is not None:
            of[event.submission] = (*of.get(event.submission, ()), event)
    return of


def _table(record: _Record, ranks: Ranks) -> Table:
    """Return the table of what has been read."""
    scored: dict[str, dict[str, int]] = {name: {} for name in RANKED}
    rows = []
    for submission, entry in record.entries.items():
        number = record.numbers.get(submission)
        history = record.events.get(submission, ())
        one = _ranked_row(entry, record.rows[submission], history, number, ranks)
        if one.section in scored and number is not None:
            scored[one.section][submission] = number
        rows.append(one)
    current = not any(scored.values()) or ranks.fingerprint == fingerprint(scored)

    def place(each: RankedRow) -> tuple[int, float, float]:
        # Their means are rounded; a row that has not been ranked yet has nothing else.
        mean = each.row.hidden.rmse_mm.mean
        ranked = ranks.places.get(each.row.submission, math.inf)
        return ORDER.index(each.section), *((ranked, mean) if current else (mean, ranked))

    rows.sort(key=place)
    return Table(rows=tuple(rows), scored=scored, current=current)


def _ranked_row(
    entry: BoardEntry,
    row: BoardRow,
    history: tuple[Event, ...],
    number: int | None,
    ranks: Ranks,
) -> RankedRow:
    """Return a row with its rank, if its section has ranks."""
    has_rank = section(row, history) in RANKED and number is not None
    rank = ranks.of(entry.submission, number) if has_rank else 0
    return RankedRow(
        rank=rank or 0,
        row=row,
        at=entry.at,
        events=history,
        submitter=entry.submitter,
        pending=rank is None,
    )
