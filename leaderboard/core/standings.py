"""Rows of a table: their sections and ranks, and the table as a data frame."""

import functools
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from datetime import datetime
from typing import TYPE_CHECKING, Final, Literal

from colift.base.errors import InputError
from colift.base.extras import how_to_install
from colift.benchmark.results.scores import ScoreTable
from colift.benchmark.statistics import Estimate, Interval
from colift.leaderboard.evaluation.scoring import PLACES
from colift.leaderboard.records.metrics import board_metrics, known_means
from colift.leaderboard.records.row import BoardRow
from colift.leaderboard.records.season import OUT, Event

if TYPE_CHECKING:
    from pandas import DataFrame

Section = Literal["ranking", "not real-time", "unverified", "out"]
"""The ranking; a second one of policies that are not real-time; and, without ranks, the unverified
rows and those that were withdrawn or removed."""


@dataclass(frozen=True)
class RankedRow:
    """A row with its rank and its events."""

    rank: int
    """Rank in its section, see :attr:`.Family.ranks`; 1 is the best. 0 is none: the
    section has no ranks, the people are too few to tell any two policies apart, or the rank is
    ``pending``."""
    row: BoardRow
    """The row of the last rescore, or of the entry if there was none."""
    at: datetime
    """Time at which it was put on the board."""
    events: tuple[Event, ...]
    """Its later events, oldest first."""
    submitter: str
    pending: bool = False
    """Whether its rank is still being computed."""

    @property
    def section(self) -> Section:
        """Its section of the table."""
        return section(self.row, self.events)

    @property
    def ranked(self) -> bool:
        """Whether it is in the ranking, rather than in that of policies that are not real-time."""
        return self.section == "ranking"


@dataclass(frozen=True, kw_only=True)
class UnrankedScores:
    """Two people, or a reference, on a season's hidden episodes."""

    rmse_mm: Estimate
    ratio: float
    """``vs_human``; 1 for two people."""
    means: Mapping[str, float | None]
    """Means of the other metrics of a board, by name."""


def section(row: BoardRow, events: tuple[Event, ...]) -> Section:
    """Return the section of a row after its events."""
    kinds = [event.kind for event in events if event.kind in (*OUT, "reinstatement")]
    if kinds and kinds[-1] in OUT:
        return "out"
    if not row.verified:
        return "unverified"
    return "ranking" if row.real_time else "not real-time"


ORDER: Final[tuple[Section, ...]] = ("ranking", "not real-time", "unverified", "out")
"""The sections of a table, in their order."""

RANKED: Final[tuple[Section, ...]] = ORDER[:2]
"""The sections that have ranks."""


def row_now(row: BoardRow, events: Sequence[Event]) -> BoardRow:
    """Return the row of the last rescore, or the row itself."""
    scored = [event.content for event in events if event.kind == "rescore"]
    return BoardRow.read(scored[-1]["row"]) if scored and scored[-1] is not None else row


@functools.lru_cache(maxsize=16)
def unranked_scores(scores: ScoreTable, human_human: ScoreTable, suite: str) -> UnrankedScores:
    """Return the published part of scores on a suite's hidden episodes, rounded like a row."""
    return UnrankedScores(
        rmse_mm=scores.error.rounded(PLACES),
        ratio=round(scores.against(human_human).ratio.mean, PLACES),
        means={
            name: None if mean is None else round(mean, PLACES)
            for name, mean in known_means(scores.means, suite).items()
        },
    )


def frame(table: Sequence[RankedRow], suite: str) -> "DataFrame":
    """Return the rows of a suite's table that have ranks; see :meth:`.Board.ranking`."""
    try:
        import pandas as pd
    except ImportError:
        raise InputError(
            f"a ranking as data frame needs pandas: {how_to_install('board')}"
        ) from None
    rows = [_flat(each) for each in table if each.section in RANKED]
    return pd.DataFrame(rows, columns=columns(suite))


def columns(suite: str) -> tuple[str, ...]:
    """Return the columns of :meth:`.Board.ranking`: RMSE and ratio are of the hidden episodes."""
    metrics = (metric.name for metric in board_metrics(suite))
    return (*HIDDEN_COLUMNS, *metrics, *OTHER_COLUMNS)


HIDDEN_COLUMNS: Final = (
    "section",
    "rank",
    "name",
    "authors",
    "rmse_mm",
    "rmse_mm_low",
    "rmse_mm_high",
    "vs_human",
    "vs_human_low",
    "vs_human_high",
    "better_than_human",
    "rougher",
    "failed",
    "public_rmse_mm",
    "public_rmse_mm_low",
    "public_rmse_mm_high",
    "gap",
)

OTHER_COLUMNS: Final = (
    "step_ms_p50",
    "step_ms_p99",
    "verified",
    "licence",
    "trained_on",
    "link",
    "at",
    "submission",
)


def _flat(each: RankedRow) -> tuple[object, ...]:
    row, hidden, public = each.row, each.row.hidden, each.row.public
    return (
        each.section,
        each.rank,
        row.name,
        ", ".join(row.authors),
        hidden.rmse_mm.mean,
        *_ends(hidden.rmse_mm),
        hidden.vs_human.mean,
        *_ends(hidden.vs_human),
        hidden.better_than_human,
        None if hidden.rougher is None else " ".join(hidden.rougher),
        hidden.failed,
        public.rmse_mm.mean,
        *_ends(public.rmse_mm),
        row.gap.mean,
        *(public.metrics[metric.name].mean for metric in board_metrics(row.suite)),
        public.step_ms_p50,
        public.step_ms_p99,
        row.verified,
        row.licence,
        row.trained_on,
        row.link,
        each.at,
        row.submission,
    )


def _ends(estimate: Estimate) -> Interval | tuple[None, None]:
    return estimate.ci95 or (None, None)
