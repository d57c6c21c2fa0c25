"""A board's row for a terminal."""

from collections.abc import Sequence
from typing import Final

from colift.benchmark.comparison.formatting import between, probability
from colift.benchmark.statistics import Estimate
from colift.benchmark.tables.printing import table
from colift.leaderboard.core.standings import Section
from colift.leaderboard.records.metrics import board_metrics
from colift.leaderboard.records.row import BoardRow
from rich.table import Table

UNRANKED: Final[dict[Section, str]] = {
    "unverified": "No rank: without a sandbox a row is not verified",
    "out": "No rank: it was taken out of the ranking",
}

SectionRow = tuple[Section, int, BoardRow]
"""A row with its section of the season's table and its rank there."""


def row_table(row: BoardRow) -> Table:
    """Return the scores of a policy on public and on hidden lifts, side by side."""
    return table(
        f"{row.name} by {', '.join(row.authors)}",
        ("", "public lifts", "hidden lifts"),
        (
            ("RMSE mm", *(_estimate(each.rmse_mm) for each in (row.public, row.hidden))),
            ("vs_human", *(_estimate(each.vs_human) for each in (row.public, row.hidden))),
            ("failed", *(f"{each.failed} of {each.episodes}" for each in (row.public, row.hidden))),
            ("P(vs_human < 1)", "", probability(row.hidden.better_than_human)),
        ),
        caption=f"season {row.season}, {row.suite}, suite digest {row.suite_digest}. "
        "P: probability that vs_human is below 1 with other people.",
    )


def row_text(
    row: BoardRow, ranking: Sequence[tuple[int, BoardRow]], section: Section = "ranking"
) -> str:
    """Return the lines below the table: rank, gap, metrics, time per step, and isolation."""
    public = row.public
    metrics = (
        f"{metric.label} {metric.text(public.metrics[metric.name].mean)} {metric.unit}".rstrip()
        for metric in board_metrics(row.suite)
    )
    lines = [
        UNRANKED.get(section) or _rank(row, ranking, section),
        f"Gap {_estimate(row.gap)}: vs_human on hidden lifts over that on public ones",
        ", ".join(metrics),
    ]
    if public.step_ms_p50 is not None and public.step_ms_p99 is not None:
        speed = "real-time capable" if row.real_time else "not real-time capable"
        lines.append(
            f"Time per step: median {public.step_ms_p50:.3f} ms, p99 {public.step_ms_p99:.3f} ms: "
            f"{speed}"
        )
    status = "verified" if row.verified else "not verified, the policy was not isolated"
    lines.append(f"Isolation {row.isolation}: {status}")
    return "\n".join(lines)


def _rank(row: BoardRow, ranking: Sequence[tuple[int, BoardRow]], section: Section) -> str:
    rank = next(rank for rank, each in ranking if each.submission == row.submission)
    if not rank:
        return "No rank: the people are too few to rank the policies of this board"
    sharing = sum(each == rank for each, _ in ranking) - 1
    shared = f", shared with {sharing}" if sharing else ""
    slow = "" if section == "ranking" else " that are not real-time"
    return f"Rank {rank} of {len(ranking)} policies{slow}{shared}"


def _estimate(estimate: Estimate) -> str:
    interval = between(estimate.ci95, ".2f")
    return f"{estimate.mean:.2f}" + (f" ({interval})" if interval else "")
