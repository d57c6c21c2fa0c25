"""Seasons, their entries and their events."""

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from datetime import datetime
from pathlib import Path
from typing import Any, Literal, Self

import msgspec
from colift.base.errors import InputError
from colift.benchmark.suites.hidden import commitment, hidden_suite
from colift.benchmark.suites.suite import Suite
from colift.leaderboard.records.row import BoardRow


@dataclass(frozen=True, kw_only=True)
class Season:
    """Suite and secret of a season, on which its submissions are evaluated."""

    name: str
    suite: Suite
    """The public episodes."""
    secret: bytes = field(repr=False)
    """The hidden episodes are derived from it."""

    @property
    def commitment(self) -> str:
        """The commitment to the secret; see :func:`.commitment`."""
        return commitment(self.secret)

    @property
    def hidden(self) -> Suite:
        """The hidden episodes; see :func:`.hidden_suite`."""
        return hidden_suite(self.suite, self.secret)


@dataclass(frozen=True, kw_only=True)
class SeasonInfo:
    """The published facts of a season, which has one suite, one secret and one table."""

    __pydantic_config__ = {"use_attribute_docstrings": True}  # noqa: RUF012  The API's descriptions.

    name: str
    suite: str
    suite_digest: str
    commitment: str
    """SHA-256 of the secret."""
    began_at: datetime
    current: bool
    """Whether it takes submissions; all others are frozen."""
    revealed: str | None
    """The secret, 64 hexadecimal digits, if it has been published: anyone can then run the hidden
    episodes and check the commitment."""


Kind = Literal[
    "season",
    "revelation",
    "withdrawal",
    "removal",
    "reinstatement",
    "rescore",
    "retry",
    "cancellation",
]
"""A season began or its secret was published; a submission was withdrawn by its submitter,
removed by the maintainer, reinstated, rescored, queued again, or cancelled."""

OUT: tuple[Kind, ...] = ("withdrawal", "removal")
"""Events after which a row is in no ranking, until a reinstatement."""


@dataclass(frozen=True, kw_only=True)
class Event:
    """An act on a season, or on a submission in it."""

    at: datetime
    who: str
    kind: Kind
    why: str
    season: str
    submission: str | None
    content: Mapping[str, Any] | None
    """Its data: a revealed ``secret``, a new ``row``."""

    def plain(self) -> dict[str, Any]:
        """Return the event as JSON."""
        return {**vars(self), "at": self.at.isoformat()}


@dataclass(frozen=True, kw_only=True)
class BoardEntry:
    """An evaluated submission: its row, or the reason for having none."""

    season: str
    submission: str
    """Digest of its content."""
    name: str
    """Name of its policy."""
    submitter: str
    """Name of the token it was submitted with, or ``local``."""
    at: datetime
    row: BoardRow | None
    refusal: str | None

    def plain(self) -> dict[str, Any]:
        """Return the entry as JSON."""
        return {
            "season": self.season,
            "submission": self.submission,
            "name": self.name,
            "submitter": self.submitter,
            "at": self.at.isoformat(),
            "row": None if self.row is None else self.row.plain(),
            "refusal": self.refusal,
        }

    @classmethod
    def read(cls, content: Mapping[str, Any]) -> Self:
        """Return the entry from the output of :meth:`plain`; as :meth:`.BoardRow.read`."""
        row = None if content["row"] is None else BoardRow.read(content["row"])
        return replace(msgspec.convert({**content, "row": None}, cls), row=row)


@dataclass(frozen=True, kw_only=True)
class PlayedEntry:
    """An entry that was evaluated elsewhere, with all that a board keeps of it."""

    entry: BoardEntry
    hidden_rmse_mm: tuple[float, ...] = field(default=(), repr=False)
    """RMSE of each hidden episode, if it has a row: the ranks follow from it."""
    files: Mapping[str, bytes] = field(default_factory=dict, repr=False)
    """Files of the public run by name, if they are there."""


def check_season_suite(place: Path | str, suite: str, wanted: str | None) -> None:
    """Refuse a board whose current season has another suite than the wanted one, if any.

    Raises
    ------
    InputError
        If it has; ``place`` is the board's folder or address.
    """
    if wanted not in (None, suite):
        raise InputError(
            f"{place} is a board of {suite}, not of {wanted}: give another one with --board, or "
            f"begin a season with colift season begin NAME --suite {wanted}"
        )
