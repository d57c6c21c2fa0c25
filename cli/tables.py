"""Results as a person reads them in a terminal."""

from collections.abc import Iterable
from typing import Any, Final

from rich import box
from rich.table import Table
from rich.text import Text

from ..agents.isolation.ladder import DESCRIPTIONS, VERIFIABLE
from ..benchmark.headline import error, versus_human

NAMES: Final = {
    "human_human": "human-human team",
    "hold": "hold (never moves)",
    "copy": "copy (goes where the human was)",
}

COLUMNS: Final = (
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
        title=Text(f"{content['policy']['name']} on {content['suite']}"),
        caption=f"{summary['episodes']} lifts, {summary['failed']} failed; "
        f"suite digest {content['suite_digest']}",
        title_justify="left",
        caption_justify="left",
        box=box.SIMPLE_HEAD,
    )
    table.add_column("human", no_wrap=True)
    for title in ("RMSE mm", "team", *(title for _, title, _ in COLUMNS)):
        table.add_column(title, justify="right", no_wrap=True)
    groups = content["groups"]
    for behaviour in dict.fromkeys(group["behaviour"] for group in groups):
        table.add_row(behaviour, *_row([g for g in groups if g["behaviour"] == behaviour]))
    table.add_section()
    table.add_row("all", *_row(groups), style="bold")
    return table


def standing(content: dict[str, Any]) -> str:
    """Return the lines that say where the policy stands."""
    summary = content["summary"]
    step = summary["step_ms"]
    lines = [error(summary)]
    if summary["vs_human"] is not None:
        lines.append(f"{versus_human(summary)}: 1 is as good as a human partner, less is better")
    for name, reference in content["references"].items():
        lines.append(f"  {NAMES.get(name, name)}: {reference['rmse_mm']['mean']:.2f} mm")
    if summary["goal_missed"]:
        lines.append(
            f"The human did not reach the intended height in {summary['goal_missed']} "
            f"of {summary['episodes']} lifts."
        )
    if step["p99"] is not None:
        lines.append(f"Policy time per step: median {step['p50']:.3f} ms, p99 {step['p99']:.3f} ms")
    if content["isolation"] in DESCRIPTIONS:
        told = "" if content["isolation"] in VERIFIABLE else "; no board would call this verified"
        lines.append(f"Isolation: {content['isolation']}{told}")
    return "\n".join(lines)


def _row(groups: list[dict[str, Any]]) -> list[str]:
    """Return the cells of a row: the means over the groups' episodes."""
    weights = [group["episodes"] for group in groups]
    known = [group["human_human_rmse_mm"]["mean"] for group in groups]
    team = None
    if None not in known:
        team = sum(w * mean for w, mean in zip(weights, known, strict=True)) / sum(weights)
    errors = [_cell(_pooled(groups, "rmse_mm"), ".1f"), _cell(team, ".1f")]
    return errors + [_cell(_pooled(groups, name), digits) for name, _, digits in COLUMNS]


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
