"""Results as a person reads them in a terminal."""

from collections.abc import Iterable, Sequence
from typing import Any, Final

from rich.table import Table

from ...agents.actions import HAND_SPEED
from ...agents.hardware.setup import LOWEST_RATE
from ...agents.sandbox.host.levels import LEVELS, VERIFIABLE
from ...benchmark.episode.metric import LEADING, Metric, Metrics
from ...benchmark.results.headline import error, versus_human
from ..printing import number, styled, table

NAMES: Final = {
    "human_human": "human-human team",
    "hold": "hold (never moves)",
    "copy": "copy (goes where the human was)",
}

TIMES: Final = {
    "sensing_age_ms": "age of the newest frame",
    "state_ms": "reading the robot",
    "policy_ms": "policy",
    "command_ms": "command",
    "period_error_ms": "error of the period",
}
"""What of a robot's step is timed."""

MEANINGS: Final = (
    "two people: RMSE mm of a human-human team on the same lifts. SPARC, LDLJ: smoothness of the "
    "robot's end, closer to 0 is smoother. force: at the human's hands. lag: of the robot behind "
    "the human."
)
"""What the columns mean."""


def results_table(content: dict[str, Any], metrics: Metrics) -> Table:
    """Return the table of a result: one row per behaviour, and the mean over all."""
    summary, groups = content["summary"], content["groups"]
    shown = [each for each in metrics.values() if each.shown != "file" and each.name != LEADING]
    behaviours = dict.fromkeys(group["behaviour"] for group in groups)
    return table(
        f"{content['policy']['name']} on {content['suite']}",
        ("human", "RMSE mm", "two people", *(metric.heading for metric in shown)),
        [
            *(
                (name, *_row([g for g in groups if g["behaviour"] == name], shown))
                for name in behaviours
            ),
            None,
            styled(("all", *_row(groups, shown)), "bold"),
        ],
        caption=f"{summary['episodes']} lifts, {summary['failed']} failed; "
        f"suite digest {content['suite_digest']}. {MEANINGS}",
    )


def standing(content: dict[str, Any]) -> str:
    """Return the lines that say where the policy stands."""
    summary = content["summary"]
    step = summary["step_ms"]
    lines = [error(summary)]
    if summary["vs_human"] is not None:
        lines.append(f"{versus_human(summary)}: 1 is as good as a human partner, less is better")
    for name, baseline in content["baselines"].items():
        lines.append(f"  {NAMES.get(name, name)}: {baseline['rmse_mm']['mean']:.2f} mm")
    if summary["goal_missed"]:
        lines.append(
            f"The human did not reach the intended height in {summary['goal_missed']} "
            f"of {summary['episodes']} lifts."
        )
    clipped = summary.get("clipped", {}).get("mean")
    if clipped is not None:
        lines.append(
            f"{100 * clipped:.1f} % of the actions were cut to the most that the hands can go "
            f"({HAND_SPEED:g} m/s)."
        )
    if step["p99"] is not None:
        lines.append(f"Policy time per step: median {step['p50']:.3f} ms, p99 {step['p99']:.3f} ms")
    if content["isolation"] in LEVELS:
        told = "" if content["isolation"] in VERIFIABLE else "; no board would call this verified"
        lines.append(f"Isolation: {content['isolation']}{told}")
    return "\n".join(lines)


def _row(groups: list[dict[str, Any]], shown: Sequence[Metric]) -> list[str]:
    """Return the cells of a row: the means over the groups' episodes."""
    weights = [group["episodes"] for group in groups]
    known = [group["human_human_rmse_mm"]["mean"] for group in groups]
    team = None
    if None not in known:
        team = sum(w * mean for w, mean in zip(weights, known, strict=True)) / sum(weights)
    errors = [number(_pooled(groups, "rmse_mm"), ".1f"), number(team, ".1f")]
    return errors + [metric.text(_pooled(groups, metric.name)) for metric in shown]


def _pooled(groups: Iterable[dict[str, Any]], name: str) -> float | None:
    """Return the mean of a metric over the episodes of several groups that have it."""
    total, count = 0.0, 0
    for group in groups:
        have = group["episodes"] - group[name]["missing"]
        if have:
            total += group[name]["mean"] * have
            count += have
    return total / count if count else None


def timing_table(report: dict[str, Any]) -> Table:
    """Return the table of a robot's latency report; see :func:`.timing_report`."""
    held = ", ".join(f"{count} x {reason}" for reason, count in report["held"].items())
    rate = report["lowest_rate_hz"]
    frames = "" if rate is None else f"frames a second: {rate:.0f} or more"
    if rate is not None and rate < LOWEST_RATE:
        frames += f", fewer than the {LOWEST_RATE:.0f} that a set-up asks for"
    if report["misdated"]:
        frames += f"; {report['misdated']} left out for their time stamps"
    return table(
        "Times in ms",
        ("", "median", "p99", "largest"),
        (
            (title, *(number(report[name][key], ".2f") for key in ("p50", "p99", "max")))
            for name, title in TIMES.items()
        ),
        caption=f"{report['steps']} steps; {report['late_steps']} periods skipped; "
        f"held: {held or 'never'}\n{frames}",
    )
