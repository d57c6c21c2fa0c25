"""The suite of a season, if this colift still plays it."""

from colift.base.errors import InputError
from colift.benchmark.suites.suite import Suite, make_suite
from colift.leaderboard.records.season import SeasonInfo


def season_suite(info: SeasonInfo) -> Suite | None:
    """Return the public lifts of a season; None if this colift has another suite of that name."""
    try:
        suite = make_suite(info.suite)
    except InputError:
        return None
    return suite if suite.digest == info.suite_digest else None
