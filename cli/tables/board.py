"""A season's table as a person reads it in a terminal."""

from collections.abc import Iterator, Sequence

from rich.table import Column, Table

from ...benchmark.episode.metric import Metric
from ...benchmark.statistics import Estimate
from ...leaderboard.board.standings import HumanHumanScores, RankedRow
from ...leaderboard.records.metrics import board_metrics
from ...leaderboard.records.row import BoardRow
from ...leaderboard.records.season import SeasonInfo
from ..printing import Cell, optional_number, styled, table

NARROW = 100
"""Below so many columns the table leaves out what is least asked for."""


def board_table(
    season: SeasonInfo,
    standings: Sequence[RankedRow],
    human_human: HumanHumanScores | None,
    width: int,
) -> Table:
    """Return a season's table: policies that cannot be distinguished share a rank.

    The human-human baseline stands where it would come by its mean.

    Parameters
    ----------
    season, standings, human_human
        What the board says of them.
    width
        Columns of the terminal.
    """
    wide = width >= NARROW
    metrics = board_metrics(season.suite)[: None if wide else 1]
    titles = ["rank", "policy", "RMSE mm", "95 % interval", "vs human"]
    titles += [metric.heading for metric in metrics]
    titles += ["ms/step", "gap mm"] if wide else []
    titles += ["verified"]
    lines = list(_lines(standings, human_human, metrics, wide))
    columns: list[str | Column] = [Column("rank", justify="right", no_wrap=True), *titles[1:]]
    most = _room(titles, lines, 1, width)
    columns[1] = Column("policy", overflow="ellipsis", no_wrap=True, max_width=most)
    title = f"Season {season.name} on {season.suite}"
    return table(title, columns, lines, caption=_caption(metrics, wide))


def _room(titles: Sequence[str], lines: Sequence[Sequence[Cell]], place: int, width: int) -> int:
    """Return how many columns of the terminal are left for one column of the table."""
    widths = [max(map(len, cells)) for cells in zip(titles, *lines, strict=True)]
    between = 2 * len(titles) + 1
    return max(width - between - sum(widths) + widths[place], len(titles[place]))


def _lines(
    standings: Sequence[RankedRow],
    human_human: HumanHumanScores | None,
    metrics: Sequence[Metric],
    wide: bool,
) -> Iterator[Sequence[Cell]]:
    """Yield the cells of each line."""
    waiting = human_human
    for each in standings:
        if waiting is not None and (
            not each.ranked or each.row.hidden.rmse_mm.mean > waiting.rmse_mm.mean
        ):
            yield styled(_human_human(waiting, metrics, wide), "bold")
            waiting = None
        yield styled(_cells(each, metrics, wide), "" if each.ranked else "dim")
    if waiting is not None:
        yield styled(_human_human(waiting, metrics, wide), "bold")


def _cells(each: RankedRow, metrics: Sequence[Metric], wide: bool) -> list[str]:
    row, hidden = each.row, each.row.hidden
    cells: list[str] = [
        _rank(each),
        row.name,
        f"{hidden.rmse_mm.mean:.2f}",
        _interval(hidden.rmse_mm),
        f"{hidden.vs_human.mean:.2f}",
        *(metric.text(row.public.metrics[metric.name].mean) for metric in metrics),
    ]
    if wide:
        cells += [_step(row), f"{row.gap_mm.mean:+.2f}"]
    return [*cells, "yes" if row.verified else "no"]


def _rank(each: RankedRow) -> str:
    if each.section == "not real-time":
        return f"slow {each.group or ''}".rstrip()
    if each.section == "ranking":
        return str(each.group or "-")
    return each.section


def _human_human(baseline: HumanHumanScores, metrics: Sequence[Metric], wide: bool) -> list[str]:
    cells: list[str] = [
        "",
        "two people",
        f"{baseline.rmse_mm.mean:.2f}",
        _interval(baseline.rmse_mm),
        "1.00",
        *(metric.text(baseline.means[metric.name]) for metric in metrics),
    ]
    return [*cells, *(["", ""] if wide else []), ""]


def _caption(metrics: Sequence[Metric], wide: bool) -> str:
    common = "One rank: no significant difference. RMSE: hidden lifts. vs human: 1 is two people"
    if not wide:
        return f"{common}. {metrics[0].symbol}: public lifts."
    shown = ", ".join(
        metric.symbol if metric.noun == metric.symbol else f"{metric.symbol} ({metric.noun})"
        for metric in metrics
    )
    return (
        f"{common}, less is better. {shown} and time per step: public lifts. "
        "Gap: hidden minus public RMSE."
    )


def _interval(estimate: Estimate) -> str:
    low, high = estimate.ci95
    return f"{low:.2f} to {high:.2f}"


def _step(row: BoardRow) -> str:
    time = optional_number(row.public.step_ms_p50, ".3f")
    return time if row.real_time else f"{time}, slow"
