"""The table of a season: rows, sections and ranks."""

import functools
from collections.abc import Mapping
from dataclasses import dataclass
from datetime import datetime
from typing import TYPE_CHECKING, Final, Literal

from ...agents.errors import InputError
from ...agents.extras import how_to_install
from ...benchmark.results.baselines import Baseline
from ...benchmark.statistics import Estimate
from ..database.database import Database
from ..database.queries import read_entries, read_error_numbers, read_events
from ..database.schema import entries, events
from ..evaluation.scoring import PLACES
from ..records.metrics import board_metrics
from ..records.row import BoardRow
from ..records.season import OUT, Event
from .ranks import ranks

if TYPE_CHECKING:
    from pandas import DataFrame

Section = Literal["ranking", "not real-time", "unverified", "out"]
"""The ranking; a second one, of those that could not keep pace with a robot; and without ranks the
rows that had no sandbox, and those that were withdrawn or removed."""


@dataclass(frozen=True)
class RankedRow:
    """Where a row stands in its season."""

    group: int
    """Rank group in its section, 1 the best; 0 is none: the section has no ranks, or the lifts are
    too few to tell anybody from anybody."""
    row: BoardRow
    """As it is now: of the last rescore, if there was one."""
    at: datetime
    """When it was put on the board."""
    events: tuple[Event, ...]
    """What has happened to it since, oldest first."""
    submitter: str

    @property
    def section(self) -> Section:
        """Where in the table it is."""
        return section(self.row, self.events)

    @property
    def ranked(self) -> bool:
        """Whether it is in the ranking; those that are not real-time have one of their own."""
        return self.section == "ranking"


@dataclass(frozen=True, kw_only=True)
class HumanTeamScores:
    """The human-human team on a season's hidden episodes: the line that a board is read against."""

    rmse_mm: Estimate
    means: Mapping[str, float | None]
    """Of the other metrics that boards show."""


def section(row: BoardRow, events: tuple[Event, ...]) -> Section:
    """Return where a row stands, after what has happened to it."""
    kinds = [event.kind for event in events if event.kind in (*OUT, "reinstatement")]
    if kinds and kinds[-1] in OUT:
        return "out"
    if not row.verified:
        return "unverified"
    return "ranking" if row.real_time else "not real-time"


ORDER: Final[tuple[Section, ...]] = ("ranking", "not real-time", "unverified", "out")
"""The sections of a table, in their order."""

RANKED: Final[tuple[Section, ...]] = ORDER[:2]
"""Those that have ranks."""


def standings(database: Database, season: str) -> tuple[RankedRow, ...]:
    """Return the table of a season; see :meth:`.Board.standings`."""
    with database.reading() as connection:
        found = read_entries(connection, entries.c.season == season, entries.c.refusal.is_(None))
        happened = read_events(
            connection, events.c.season == season, events.c.submission.is_not(None)
        )
        numbers = read_error_numbers(connection, season)
    of: dict[str | None, list[Event]] = {}
    for event in happened:
        of.setdefault(event.submission, []).append(event)
    own = {entry.submission: tuple(of.get(entry.submission, ())) for entry in found}
    rows = {
        entry.submission: _row_now(entry.row, own[entry.submission])
        for entry in found
        if entry.row is not None
    }
    sections = {digest: section(row, own[digest]) for digest, row in rows.items()}
    scored: dict[str, dict[str, int]] = {name: {} for name in RANKED}
    for digest, name in sections.items():
        if name in scored and digest in numbers:
            scored[name][digest] = numbers[digest]
    rank = ranks(database, season, scored)
    place = {digest: number for number, digest in enumerate(rank)}
    shown = sorted(
        (entry for entry in found if entry.submission in rows),
        key=lambda entry: (
            ORDER.index(sections[entry.submission]),
            place.get(entry.submission, len(place)),
            rows[entry.submission].hidden.rmse_mm.mean,
        ),
    )
    return tuple(
        RankedRow(
            group=rank.get(entry.submission, 0),
            row=rows[entry.submission],
            at=entry.at,
            events=own[entry.submission],
            submitter=entry.submitter,
        )
        for entry in shown
    )


def _row_now(row: BoardRow, happened: tuple[Event, ...]) -> BoardRow:
    """Return a row as it is after what has happened to it."""
    scored = [event.content for event in happened if event.kind == "rescore"]
    return BoardRow.read(scored[-1]["row"]) if scored and scored[-1] is not None else row


@functools.lru_cache(maxsize=16)
def human_team(team: Baseline) -> HumanTeamScores:
    """Return what is published of the human-human team on hidden episodes: rounded, like a row."""
    return HumanTeamScores(
        rmse_mm=team.estimate.rounded(PLACES),
        means={
            name: None if mean is None else round(mean, PLACES) for name, mean in team.means.items()
        },
    )


def frame(table: tuple[RankedRow, ...]) -> "DataFrame":
    """Return the rows of a table that have ranks as a data frame; see :meth:`.Board.ranking`."""
    try:
        import pandas as pd
    except ImportError:
        raise InputError(
            f"a ranking as data frame needs pandas: {how_to_install('board')}"
        ) from None
    return pd.DataFrame([_flat(each) for each in table if each.section in RANKED], columns=COLUMNS)


COLUMNS = (
    "section",
    "group",
    "name",
    "authors",
    "rmse_mm",
    "rmse_mm_low",
    "rmse_mm_high",
    "vs_human",
    "vs_human_low",
    "vs_human_high",
    "better_than_human",
    "failed",
    "public_rmse_mm",
    "public_rmse_mm_low",
    "public_rmse_mm_high",
    "gap_mm",
    *(metric.name for metric in board_metrics()),
    "step_ms_p50",
    "step_ms_p99",
    "verified",
    "licence",
    "trained_on",
    "link",
    "at",
    "submission",
)
"""Of :meth:`.Board.ranking`. RMSE and ratio are those of the hidden episodes."""


def _flat(each: RankedRow) -> tuple[object, ...]:
    row, hidden, public = each.row, each.row.hidden, each.row.public
    return (
        each.section,
        each.group,
        row.name,
        ", ".join(row.authors),
        hidden.rmse_mm.mean,
        *hidden.rmse_mm.ci95,
        hidden.vs_human.mean,
        *hidden.vs_human.ci95,
        hidden.better_than_human,
        hidden.failed,
        public.rmse_mm.mean,
        *public.rmse_mm.ci95,
        row.gap_mm.mean,
        *(public.metrics[metric.name].mean for metric in board_metrics()),
        public.step_ms_p50,
        public.step_ms_p99,
        row.verified,
        row.licence,
        row.trained_on,
        row.link,
        each.at,
        row.submission,
    )
