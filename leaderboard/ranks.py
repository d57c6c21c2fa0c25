"""Rank groups of a season: computed from the hidden episodes, lift by lift, once for each state."""

import hashlib
import json
import threading
from collections.abc import Mapping
from typing import Final

import sqlalchemy as sa

from ..benchmark.statistics import rank_groups as grouped
from ..benchmark.statistics.ranking import RankGroups
from .database.database import Database
from .database.reading import read_errors
from .database.schema import rank_groups

METHOD: Final = 1
"""Number of the method; it is raised by every change that moves a rank."""

LEAST: Final = 10_000
"""Sign flips of a test, at least."""

FLIPS: Final = 40
"""Sign flips for each policy. Corrected for n tests (Holm), the smallest p value that m flips can
give is n / (m + 1): with m = 40 n that is half of the level, with too few nobody could be told from
anybody."""

_computing: Final = threading.Lock()
"""Whoever asks while another thread computes the same waits for it."""


def ranks(database: Database, season: str, scored: Mapping[str, int]) -> dict[str, int]:
    """Return the rank group of each submission, 1 the best, in that order.

    See :func:`.rank_groups`. What has been computed before is looked up.

    Parameters
    ----------
    database
        The board's.
    season
        Name of the season.
    scored
        The submissions to rank; of each the number of the ``hidden_errors`` that count.
    """
    if not scored:
        return {}
    mark = hashlib.sha256(json.dumps([METHOD, sorted(scored.items())]).encode()).hexdigest()
    this = (rank_groups.c.season == season) & (rank_groups.c.fingerprint == mark)
    known = _known(database, this)
    if known is None:
        with _computing:
            known = _known(database, this)
            if known is None:
                with database.reading() as connection:
                    errors = read_errors(connection, season, scored)
                known = grouped(errors, resamples=max(LEAST, FLIPS * len(errors)))
                _keep(database, {"season": season, "fingerprint": mark, "groups": known})
    return {digest: rank for rank, group in enumerate(known, 1) for digest in group}


def _known(database: Database, this: sa.ColumnElement[bool]) -> RankGroups | None:
    with database.reading() as connection:
        found: RankGroups | None = connection.scalar(sa.select(rank_groups.c.groups).where(this))
    return found


def _keep(database: Database, content: Mapping[str, object]) -> None:
    """Keep groups instead of those before; another process may have done the same."""
    with database.writing() as connection:
        old = rank_groups.c.season == content["season"]
        connection.execute(sa.delete(rank_groups).where(old))
        connection.execute(sa.insert(rank_groups).values(**content))
