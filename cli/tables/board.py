"""A season's table for a terminal."""

from collections.abc import Iterator, Sequence

from colift.benchmark.comparison.formatting import between
from colift.benchmark.episode.metric import Metric
from colift.benchmark.results.roughness import ROUGHER, SIGN
from colift.benchmark.statistics import Estimate
from colift.benchmark.tables.printing import Cell, optional_number, styled, table
from colift.leaderboard.core.standings import RankedRow, UnrankedScores
from colift.leaderboard.records.metrics import board_metrics
from colift.leaderboard.records.row import BoardRow
from colift.leaderboard.records.season import SeasonInfo
from rich.table import Column, Table

NAME = 12
"""Width reserved for the policies' names, if they are that long: other columns make room."""


def board_table(
    season: SeasonInfo,
    standings: Sequence[RankedRow],
    human_human: UnrankedScores | None,
    width: int,
) -> Table:
    """Return a season's table, by rank.

    Two people are placed by their mean.

    Parameters
    ----------
    season, standings, human_human
        The season's content on the board.
    width
        Columns of the terminal. In a narrow one, time, gap and verification are left out first,
        then the last metrics.
    """
    every = board_metrics(season.suite)
    for wide, shown in [(True, len(every)), *((False, n) for n in range(len(every), 0, -1))]:
        metrics = every[:shown]
        titles = ["rank", "policy", "RMSE mm", "95 % interval", "vs human"]
        titles += [metric.heading for metric in metrics]
        titles += ["ms/step", "gap", "verified"] if wide else []
        lines = list(_lines(standings, human_human, metrics, wide))
        room, longest = _room(titles, lines, 1, width)
        if room >= min(NAME, longest):
            break
    columns: list[str | Column] = [Column("rank", justify="right", no_wrap=True), *titles[1:]]
    most = max(room, len("policy"))
    columns[1] = Column("policy", overflow="ellipsis", no_wrap=True, max_width=most)
    title = f"Season {season.name} on {season.suite}"
    caption = _caption(metrics, every[len(metrics) :], wide)
    if any(each.row.hidden.rougher for each in standings):
        caption += f" {SIGN}: {ROUGHER}."
    return table(title, columns, lines, caption=caption)


def _room(
    titles: Sequence[str], lines: Sequence[Sequence[Cell]], place: int, width: int
) -> tuple[int, int]:
    """Return the width that the terminal leaves for a column of the table, and the column's own."""
    widths = [max(map(len, cells)) for cells in zip(titles, *lines, strict=True)]
    between = 2 * len(titles) + 1
    return width - between - sum(widths) + widths[place], widths[place]


def _lines(
    standings: Sequence[RankedRow],
    human_human: UnrankedScores | None,
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
        cells += [_step(row), f"{row.gap.mean:.2f}", "yes" if row.verified else "no"]
    return cells


def _rank(each: RankedRow) -> str:
    mark = f" {SIGN}" if each.row.hidden.rougher else ""
    if each.section == "not real-time":
        return f"slow {each.rank or ''}".rstrip() + mark
    if each.section == "ranking":
        return str(each.rank or "-") + mark
    return each.section + mark


def _human_human(baseline: UnrankedScores, metrics: Sequence[Metric], wide: bool) -> list[str]:
    cells: list[str] = [
        "",
        "two people",
        f"{baseline.rmse_mm.mean:.2f}",
        _interval(baseline.rmse_mm),
        "1.00",
        *(metric.text(baseline.means[metric.name]) for metric in metrics),
    ]
    return [*cells, *([""] * 3 if wide else [])]


def _caption(metrics: Sequence[Metric], left_out: Sequence[Metric], wide: bool) -> str:
    common = (
        "Rank: 1 + the policies that are better beyond chance. RMSE: hidden lifts. vs human: 1 is "
        "two people"
    )
    if wide:
        shown = ", ".join(map(_named, metrics))
        text = (
            f"{common}, less is better. {shown} and time per step: public lifts. "
            "Gap: vs human on hidden lifts over that on public ones."
        )
    else:
        text = f"{common}. {', '.join(metric.symbol for metric in metrics)}: public lifts."
    missing = ", ".join(metric.symbol for metric in left_out)
    return f"{text} Only in a wider terminal: {missing}." if missing else text


def _named(metric: Metric) -> str:
    same = metric.noun == metric.symbol
    return metric.symbol if same else f"{metric.symbol} ({metric.noun})"


def _interval(estimate: Estimate) -> str:
    return between(estimate.ci95, ".2f")


def _step(row: BoardRow) -> str:
    time = optional_number(row.public.step_ms_p50, ".3f")
    return time if row.real_time else f"{time}, slow"
