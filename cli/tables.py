"""Results as a person reads them in a terminal."""

from collections.abc import Iterable
from typing import Any, Final

from rich import box
from rich.table import Table

PAPER_HUMAN_TEAM_MM: Final = 6.531
"""RMSE of the paper's one human-human team (section V.A)."""

COLUMNS: Final = (
    ("rmse_mm", "RMSE mm", ".1f"),
    ("max_tilt_deg", "tilt °", ".1f"),
    ("sparc", "SPARC", ".2f"),
    ("ldlj", "LDLJ", ".1f"),
    ("human_force_n", "force N", ".2f"),
    ("robot_lag_ms", "lag ms", ".0f"),
)


def results_table(content: dict[str, Any]) -> Table:
    """Return the table of a result: one row a behaviour, and the mean over all."""
    summary = content["summary"]
    table = Table(
        title=f"{content['policy']['name']} on {content['suite']}",
        caption=f"{summary['episodes']} lifts, {summary['failed']} failed; "
        f"suite digest {content['suite_digest']}",
        title_justify="left",
        caption_justify="left",
        box=box.SIMPLE_HEAD,
    )
    table.add_column("human", no_wrap=True)
    for _, title, _ in COLUMNS:
        table.add_column(title, justify="right")
    table.add_column("lifts", justify="right")
    behaviours = dict.fromkeys(group["behaviour"] for group in content["groups"])
    for behaviour in behaviours:
        groups = [group for group in content["groups"] if group["behaviour"] == behaviour]
        cells = [_cell(_pooled(groups, name), digits) for name, _, digits in COLUMNS]
        table.add_row(behaviour, *cells, str(sum(group["episodes"] for group in groups)))
    table.add_section()
    cells = [_cell(summary[name]["mean"], digits) for name, _, digits in COLUMNS]
    table.add_row("all", *cells, str(summary["episodes"]), style="bold")
    return table


def standing(content: dict[str, Any]) -> str:
    """Return the lines that say where the policy stands."""
    rmse = content["summary"]["rmse_mm"]
    low, high = rmse["ci95"]
    interval = f" (95 % interval {low:.1f} to {high:.1f})" if high > low else ""
    step = content["summary"]["step_ms"]
    lines = [f"RMSE {rmse['mean']:.2f} mm{interval}"]
    for name, reference in content["references"].items():
        other = reference["rmse_mm"]["mean"]
        lines.append(f"  against {name}: {other:.2f} mm, ratio {rmse['mean'] / other:.3f}")
    lines.append(f"  against the paper's human-human team: {PAPER_HUMAN_TEAM_MM:.3f} mm (one team)")
    if content["summary"]["goal_missed"]:
        lines.append(
            f"The human did not reach the intended height in {content['summary']['goal_missed']} "
            f"of {content['summary']['episodes']} lifts."
        )
    if step["p99"] is not None:
        lines.append(f"Policy time per step: median {step['p50']:.3f} ms, p99 {step['p99']:.3f} ms")
    return "\n".join(lines)


def _pooled(groups: Iterable[dict[str, Any]], name: str) -> float | None:
    """Return the mean of a metric over the episodes of several groups that have it."""
    total, count = 0.0, 0
    for group in groups:
        have = group["episodes"] - group[name]["missing"]
        if have:
            total += group[name]["mean"] * have
            count += have
    return total / count if count else None


def _cell(value: float | None, digits: str) -> str:
    return "none" if value is None else format(value, digits)
