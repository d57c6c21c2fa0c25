"""From the entries and events of a season to its table."""

import functools
from typing import TYPE_CHECKING

from ..agents.errors import InputError
from ..benchmark.comparison.standing import Estimate
from ..benchmark.references import Reference
from ..benchmark.statistics import stratified_bootstrap
from .database.database import Database
from .database.reading import read_entries, read_error_numbers, read_events
from .database.schema import entries, events
from .event import Event
from .ranks import ranks
from .row import Row
from .scoring import PLACES
from .standing import HumanTeam, Standing, out_of_ranking

if TYPE_CHECKING:
    from pandas import DataFrame


def standings(database: Database, season: str) -> tuple[Standing, ...]:
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
    out = {digest for digest, these in own.items() if out_of_ranking(these)}
    rank = ranks(database, season, {d: n for d, n in numbers.items() if d in own.keys() - out})
    place = {digest: number for number, digest in enumerate(rank)}
    table = [
        Standing(
            group=rank.get(entry.submission, 0),
            row=_row_now(entry.row, own[entry.submission]),
            at=entry.at,
            events=own[entry.submission],
            submitter=entry.submitter,
        )
        for entry in found
        if entry.row is not None
    ]
    return tuple(sorted(table, key=lambda each: place.get(each.row.submission, len(place))))


def _row_now(row: Row, happened: tuple[Event, ...]) -> Row:
    """Return a row as it is after what has happened to it."""
    scored = [event.content for event in happened if event.kind == "rescore"]
    return Row.read(scored[-1]["row"]) if scored and scored[-1] is not None else row


@functools.lru_cache(maxsize=16)
def human_team(team: Reference) -> HumanTeam:
    """Return what is published of the human-human team on hidden episodes: rounded, like a row."""
    low, high = stratified_bootstrap(team.rmse_mm, team.cells)
    return HumanTeam(
        rmse_mm=Estimate(
            mean=round(team.mean, PLACES), ci95=(round(low, PLACES), round(high, PLACES))
        ),
        sparc=None if team.sparc is None else round(team.sparc, PLACES),
        human_force_n=round(team.human_force_n, PLACES),
    )


def frame(table: tuple[Standing, ...]) -> "DataFrame":
    """Return the ranked rows of a table as a data frame; see :meth:`.Board.ranking`."""
    try:
        import pandas as pd
    except ImportError:
        raise InputError(
            "a ranking as data frame needs pandas: pip install 'colift[board]'"
        ) from None
    return pd.DataFrame([_flat(each) for each in table if each.ranked], columns=COLUMNS)


COLUMNS = (
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
    "sparc",
    "human_force_n",
    "step_ms_p50",
    "step_ms_p99",
    "verified",
    "at",
    "submission",
)
"""Of :meth:`.Board.ranking`. RMSE and ratio are those of the hidden episodes."""


def _flat(each: Standing) -> tuple[object, ...]:
    row, hidden, public = each.row, each.row.hidden, each.row.public
    return (
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
        public.sparc,
        public.human_force_n,
        public.step_ms_p50,
        public.step_ms_p99,
        row.verified,
        each.at,
        row.submission,
    )
