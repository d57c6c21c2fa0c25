"""Formats of numbers and times on the pages."""

from datetime import UTC, datetime, timedelta
from typing import Final

from colift.base.tex import tex
from colift.benchmark.rendering.formats import number
from colift.leaderboard.core.standings import RankedRow
from colift.leaderboard.records.metrics import sort_key


def p_text(p: float) -> str:
    """Return a p value; small ones as a bound."""
    return "< 0.001" if p < 0.001 else f"{p:.3f}"


def percent(share: float) -> str:
    """Return a share in per cent."""
    return f"{100 * share:.0f} %"


def day(at: datetime) -> str:
    """Return a day, such as 20 Nov 2026, in universal time."""
    utc = at.astimezone(UTC)
    return f"{utc.day} {utc:%b %Y}"


def minute(at: datetime) -> str:
    """Return a day and a time of day, in universal time."""
    return f"{day(at)}, {at.astimezone(UTC):%H:%M} UTC"


def duration(time: timedelta) -> str:
    """Return a duration in its largest units, such as 40 s, 12 min or 1 h 5 min."""
    seconds = max(0, round(time.total_seconds()))
    if seconds < 100:
        return f"{seconds} s"
    hours, minutes = divmod(round(seconds / 60), 60)
    return f"{hours} h {minutes} min" if hours else f"{minutes} min"


def mib(size: int) -> str:
    """Return a number of bytes in MiB."""
    return f"{size / 1048576:g} MiB"


def badge_text(standing: RankedRow) -> str:
    """Return the text of a row's badge."""
    mm = f"{number(standing.row.hidden.rmse_mm.mean)} mm"
    if standing.pending:
        return f"{mm} · being ranked"
    return f"{mm} · " + (
        f"rank {standing.rank}" if standing.ranked and standing.rank else "not ranked"
    )


FILTERS: Final = {
    each.__name__: each
    for each in (
        p_text,
        percent,
        day,
        minute,
        duration,
        mib,
        badge_text,
        tex,
        sort_key,
    )
}
"""These formats by name, for templates; those of :mod:`.rendering.formats` are there, too."""
