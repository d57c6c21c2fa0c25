"""The seasons of a board: start, end and import."""

import re
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from datetime import UTC, datetime
from typing import Any, Final

import sqlalchemy as sa
from colift.base.errors import InputError
from colift.benchmark.results.scores import ScoreTable
from colift.benchmark.suites.hidden import commitment, new_secret
from colift.benchmark.suites.suite import make_suite
from colift.leaderboard.database.connection import Database
from colift.leaderboard.database.queries import read_seasons, record_entry, record_event
from colift.leaderboard.database.schema import seasons
from colift.leaderboard.records.season import Event, Kind, PlayedEntry, Season, SeasonInfo
from colift.leaderboard.storage.files import sync_tree
from colift.leaderboard.storage.store import Store

Clock = Callable[[], datetime]
"""A function that returns a time with its zone."""


def utc_now() -> datetime:
    """Return the time of this machine."""
    return datetime.now(UTC)


@dataclass(frozen=True, kw_only=True)
class ImportedSeason:
    """A season with a public secret, to be imported."""

    info: SeasonInfo
    """With the secret. ``current`` states whether it also takes submissions."""
    entries: Sequence[PlayedEntry]
    human_human: ScoreTable
    """Two people on the hidden episodes."""
    references: Mapping[str, ScoreTable] = field(default_factory=dict)
    """The references on the hidden episodes, by name."""


NAME: Final = re.compile(r"[A-Za-z0-9][A-Za-z0-9_-]{0,39}")
"""Pattern of a season's name."""


@dataclass(frozen=True)
class SeasonBook:
    """The seasons of a board, and their secrets."""

    store: Store
    database: Database
    clock: Clock

    def read(self) -> tuple[SeasonInfo, ...]:
        """Return all seasons, oldest first."""
        with self.database.reading() as connection:
            return read_seasons(connection)

    def current(self) -> SeasonInfo:
        """Return the season that takes submissions."""
        return next(each for each in self.read() if each.current)

    def named(self, name: str) -> SeasonInfo:
        """Return the published facts of a season.

        Raises
        ------
        InputError
            If there is no such season.
        """
        found = self.read()
        for each in found:
            if each.name == name:
                return each
        known = ", ".join(each.name for each in found)
        raise InputError(f"{self.store.folder} has no season {name!r}; it has {known}")

    def playable(self, name: str) -> Season:
        """Return the suite and secret of a season; see :meth:`.Board.season_of`."""
        info = self.named(name)
        suite = make_suite(info.suite)
        if suite.digest != info.suite_digest:
            raise InputError(
                f"season {name} of {self.store.folder} is on {suite.name} of digest "
                f"{info.suite_digest}, this colift plays {suite.digest}: begin a new season"
            )
        season = Season(name=name, suite=suite, secret=self.store.secrets(name).secret())
        if season.commitment != info.commitment:
            raise InputError(f"the secret of season {name} does not match its commitment")
        return season

    def begin(self, name: str, suite: str, who: str) -> None:
        """Begin a season with a new secret; the board's lock is held."""
        if not NAME.fullmatch(name):
            raise InputError(f"season {name!r} must be letters, digits, - and _, at most 40")
        if name in (each.name for each in self.read()):
            raise InputError(f"{self.store.folder} already has a season {name}")
        made, secrets, secret = make_suite(suite), self.store.secrets(name), new_secret()
        secrets.forget_secret()  # Left by a process that was killed.
        secrets.keep_secret(secret)
        info = SeasonInfo(
            name=name,
            suite=made.name,
            suite_digest=made.digest,
            commitment=commitment(secret),
            began_at=self.clock(),
            current=True,
            revealed=None,
        )
        with self.database.writing() as connection:
            self._record(connection, info, who, "begun")

    def reveal(self, name: str, who: str, why: str) -> None:
        """Publish the secret of a frozen season; see :meth:`.Board.reveal`."""
        info = self.named(name)
        if info.current:
            raise InputError(f"season {name} still takes submissions: begin another one first")
        if info.revealed is None:
            secret = self.playable(name).secret.hex()
            with self.database.writing() as connection:
                self._event(connection, "revelation", name, who, why, {"secret": secret})

    def import_season(self, practice: ImportedSeason, who: str, why: str) -> None:
        """Import a season; see :meth:`.Board.import_season`. The board's lock is held."""
        info = practice.info
        if info.name in (each.name for each in self.read()):
            return
        secret = bytes.fromhex(info.revealed or "")
        if commitment(secret) != info.commitment:
            raise InputError(f"season {info.name}: its secret does not match its commitment")
        secrets = self.store.secrets(info.name)
        secrets.forget_secret()
        secrets.keep_secret(secret)
        secrets.keep_human_human(practice.human_human)
        secrets.keep_references(practice.references)
        for each in practice.entries:
            place = self.store.bundle(info.name, each.entry.submission)
            for name, data in each.files.items():
                place.mkdir(parents=True, exist_ok=True)
                (place / name).write_bytes(data)
        sync_tree(self.store.folder / "public")
        with self.database.writing() as connection:
            self._record(connection, info, who, why)
            self._event(connection, "revelation", info.name, who, why, {"secret": info.revealed})
            for each in practice.entries:
                record_entry(connection, each.entry, each.hidden_rmse_mm)

    def _record(self, connection: sa.Connection, info: SeasonInfo, who: str, why: str) -> None:
        connection.execute(
            sa.insert(seasons).values(
                name=info.name,
                suite=info.suite,
                suite_digest=info.suite_digest,
                commitment=info.commitment,
                began_at=info.began_at,
                taking=info.current,
            )
        )
        self._event(connection, "season", info.name, who, why, {"commitment": info.commitment})

    def _event(
        self,
        connection: sa.Connection,
        kind: Kind,
        season: str,
        who: str,
        why: str,
        content: dict[str, Any],
    ) -> None:
        event = Event(
            at=self.clock(),
            who=who,
            kind=kind,
            why=why,
            season=season,
            submission=None,
            content=content,
        )
        record_event(connection, event)
