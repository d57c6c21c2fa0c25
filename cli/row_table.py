"""A board's row as a person reads it in a terminal."""

from collections.abc import Sequence

from rich import box
from rich.table import Table
from rich.text import Text

from ..benchmark.comparison.standing import Estimate
from ..leaderboard.row import Row


def row_table(row: Row) -> Table:
    """Return what a policy did on public and on hidden lifts, side by side."""
    public, hidden = row.public, row.hidden
    table = Table(
        title=Text(f"{row.name} by {', '.join(row.authors)}"),
        caption=f"season {row.season}, {row.suite}, suite digest {row.suite_digest}",
        title_justify="left",
        caption_justify="left",
        box=box.SIMPLE_HEAD,
    )
    table.add_column("")
    for title in ("public lifts", "hidden lifts"):
        table.add_column(title, justify="right", no_wrap=True)
    table.add_row("RMSE mm", _estimate(public.rmse_mm), _estimate(hidden.rmse_mm))
    table.add_row("vs_human", _estimate(public.vs_human), _estimate(hidden.vs_human))
    table.add_row("failed", *(f"{each.failed} of {each.episodes}" for each in (public, hidden)))
    table.add_row("better than the human team", "", f"{100 * hidden.better_than_human:.0f} %")
    return table


def standing(row: Row, ranking: Sequence[tuple[int, Row]]) -> str:
    """Return the lines that say where the row stands, and what its numbers rest on."""
    public = row.public
    rank = next(rank for rank, each in ranking if each.submission == row.submission)
    sharing = sum(each == rank for each, _ in ranking) - 1
    shared = f", shared with {sharing} that cannot be told from it" if sharing else ""
    smooth = "none" if public.sparc is None else f"{public.sparc:.2f}"
    force = "none" if public.human_force_n is None else f"{public.human_force_n:.2f} N"
    lines = [
        f"Rank {rank} of {len(ranking)} policies{shared}",
        f"Gap {_estimate(row.gap_mm)} mm: hidden minus public RMSE; other people, other plans",
        f"Smoothness SPARC {smooth}, human force {force}",
    ]
    if public.step_ms_p50 is not None and public.step_ms_p99 is not None:
        speed = "real-time capable" if public.real_time else "not real-time capable"
        lines.append(
            f"Time per step: median {public.step_ms_p50:.3f} ms, p99 {public.step_ms_p99:.3f} ms: "
            f"{speed}"
        )
    told = "verified" if row.verified else "not verified, the policy was not kept apart"
    lines.append(f"Isolation {row.isolation}: {told}")
    return "\n".join(lines)


def _estimate(estimate: Estimate) -> str:
    low, high = estimate.ci95
    return f"{estimate.mean:.2f} ({low:.2f} to {high:.2f})"
