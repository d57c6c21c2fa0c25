"""Rank groups of a season, computed from the hidden episodes and cached."""

import hashlib
import json
import threading
from collections.abc import Mapping
from typing import Final

import sqlalchemy as sa

from ...benchmark.statistics import rank_groups as grouped
from ...benchmark.statistics.ranking import RankGroups
from ..database.database import Database
from ..database.queries import read_errors
from ..database.schema import rank_groups

METHOD: Final = 2
"""Version of the method; every change that can move a rank raises it."""

LEAST: Final = 10_000
"""Least number of sign flips of a test."""

FLIPS: Final = 40
"""Sign flips for each policy. Corrected for n tests (Holm), the smallest p value that m flips can
give is n / (m + 1). With m = 40 n that is half of the level; with fewer than 20 n flips, no two
policies could be distinguished."""

_computing: Final = threading.Lock()
"""Held while ranks are computed: other threads wait for the result."""


LEVEL: Final = 0.05
"""Largest corrected p value at which two policies differ."""


def ranks(
    database: Database, season: str, scored: Mapping[str, Mapping[str, int]]
) -> dict[str, int]:
    """Return the rank group of each submission, in their order: 1 is the best, 0 is none.

    Each section is ranked by itself, see :func:`.rank_groups`. Groups that were computed before are
    looked up.

    Parameters
    ----------
    database
        The board's.
    season
        Name of the season.
    scored
        The submissions to rank, by section, each with the number of its valid ``hidden_errors``.
    """
    if not any(scored.values()):
        return {}
    plain = {section: sorted(numbers.items()) for section, numbers in scored.items()}
    mark = hashlib.sha256(json.dumps([METHOD, plain]).encode()).hexdigest()
    this = (rank_groups.c.season == season) & (rank_groups.c.fingerprint == mark)
    known = _known(database, this)
    if known is None:
        with _computing:
            known = _known(database, this)
            if known is None:
                known = [_ranked(database, season, some) for some in scored.values() if some]
                _keep(database, {"season": season, "fingerprint": mark, "groups": known})
    return {
        digest: first + place
        for first, groups in known
        for place, group in enumerate(groups)
        for digest in group
    }


Ranked = tuple[int, RankGroups]
"""The rank of the first group, and all groups. If the lifts are too few for groups, there is one of
rank 0."""


def _ranked(database: Database, season: str, numbers: Mapping[str, int]) -> Ranked:
    """Return the rank groups of the submissions of a section."""
    with database.reading() as connection:
        errors = read_errors(connection, season, numbers)
    groups = grouped(errors, level=LEVEL, resamples=max(LEAST, FLIPS * len(errors)))
    lifts = min((len(each) for each in errors.values()), default=0)
    return (1, groups) if can_distinguish(len(errors), lifts) else (0, groups)


def can_distinguish(policies: int, lifts: int) -> bool:
    """Return whether the test can distinguish the best of that many policies from any other.

    The smallest p value that the signs of n differences can give is 2 / 2^n; corrected for k tests
    (Holm), it is k times that. If it is above the level, all would share rank 1, however bad they
    are. A single policy is the best.
    """
    return (policies - 1) * 2.0 ** (1 - lifts) <= LEVEL


def _known(database: Database, this: sa.ColumnElement[bool]) -> list[Ranked] | None:
    with database.reading() as connection:
        found: list[Ranked] | None = connection.scalar(sa.select(rank_groups.c.groups).where(this))
    return found


def _keep(database: Database, content: Mapping[str, object]) -> None:
    """Replace the stored groups; another process may have done the same."""
    with database.writing() as connection:
        old = rank_groups.c.season == content["season"]
        connection.execute(sa.delete(rank_groups).where(old))
        connection.execute(sa.insert(rank_groups).values(**content))
