"""Results as tables and text for a terminal."""

from collections.abc import Iterator, Sequence
from typing import Any, Final

from colift.agents.real_time import LOWEST_RATE
from colift.agents.sandbox.host.levels import LEVELS, VERIFIABLE
from colift.benchmark.bundle import Results
from colift.benchmark.channels import channel_name
from colift.benchmark.episode.metric import LEADING, Metric, Metrics, notes
from colift.benchmark.results.baselines import HUMAN_HUMAN, HUMAN_HUMAN_LABEL
from colift.benchmark.results.curve import SessionCurve
from colift.benchmark.results.headline import error, versus_human
from colift.benchmark.results.roughness import MEANING, by_which
from colift.benchmark.results.strata import (
    StratumScore,
    human_human_mean,
    mean_of_strata,
    spread_over_people,
)
from colift.benchmark.tables.printing import counted, optional_number, styled, table
from rich.table import Table

NAMES: Final = {
    HUMAN_HUMAN: HUMAN_HUMAN_LABEL,
    "hold": "hold (never moves)",
    "copy": "copy (goes where the human was)",
}

ON_ONE_LINE: Final = 5
"""Metrics beside which a terminal of 80 columns has room for a heading of two words."""

TIMES: Final = {
    "sensing_age_ms": "age of the newest frame",
    "state_ms": "reading the robot",
    "policy_ms": "policy",
    "command_ms": "command",
    "period_error_ms": "error of the period",
}
"""The timed parts of a robot's step."""

PEOPLE: Final = "two people: RMSE in mm of two simulated people on the same lifts."
"""Meaning of the column beside the RMSE."""

QUARTILES: Final = "quartiles"

SPREAD: Final = "quartiles: of the means of each person."
"""Meaning of the next column."""

ALONE: Final = "All lifts are with one person, so that there is no interval."
"""Said instead of the quartiles if there are none."""


def results_table(content: Results, metrics: Metrics) -> Table:
    """Return the table of a result: one row per behaviour, and the mean over all."""
    summary, strata = content.summary, content.strata
    shown = [each for each in metrics.values() if each.shown != "file" and each.name != LEADING]
    behaviours = dict.fromkeys(each.behaviour for each in strata)
    people = "two people" if len(shown) <= ON_ONE_LINE else "two\npeople"
    several = spread_over_people(strata).people > 1
    quartiles = (QUARTILES,) if several else ()
    spread = SPREAD if several else ALONE if summary.rmse_mm.ci95 is None else ""
    return table(
        f"{content.policy} on {content.suite}{_over(content)}",
        ("human", "RMSE mm", people, *quartiles, *(metric.heading for metric in shown)),
        [
            *(
                (name, *_row([each for each in strata if each.behaviour == name], shown, several))
                for name in behaviours
            ),
            None,
            styled(("all", *_row(strata, shown, several)), "bold"),
        ],
        caption=f"{counted(summary.episodes, 'lift')}{_session(content)}, "
        f"{summary.failed} failed; "
        f"suite digest {content.suite_digest}. "
        + " ".join(filter(None, (PEOPLE, spread, notes(shown)))),
    )


def results_text(content: Results, metrics: Metrics) -> str:
    """Return the lines that compare the policy with the baselines."""
    summary, step = content.summary, content.summary.step_ms
    lines = [error(summary)]
    if content.channel is not None:
        lines.append(f"Channel to the policy: {content.channel}. The baselines have none.")
    if summary.vs_human is not None:
        lines.append(f"{versus_human(summary)}: 1 is as good as a human partner, less is better")
    if content.session is not None:
        lines.extend(curve_lines(content.session))
    if summary.rougher:
        lines.append(f"{MEANING} This policy is, by {by_which(summary.rougher, metrics)}.")
    for name, baseline in content.baselines.items():
        lines.append(f"  {NAMES.get(name, name)}: {baseline.mean:.2f} mm")
    if summary.goal_missed and content.goals is None:  # A real person need not follow the plan.
        lines.append(
            f"The human did not reach the intended height in {summary.goal_missed} "
            f"of {counted(summary.episodes, 'lift')}."
        )
    if content.goals is not None:
        lines.append(str(content.goals))
    clipped = summary.metrics.get("clipped")
    if clipped is not None and clipped.mean is not None:
        lines.append(
            f"{100 * clipped.mean:.1f} % of the actions exceeded the speed of the hands and were "
            "clipped."
        )
    if step.p50 is not None and step.p99 is not None:
        lines.append(f"Policy time per step: median {step.p50:.3f} ms, p99 {step.p99:.3f} ms")
    if content.isolation in LEVELS:
        note = "" if content.isolation in VERIFIABLE else "; not enough for a verified row"
        lines.append(f"Isolation: {content.isolation}{note}")
    return "\n".join(lines)


def _session(content: Results) -> str:
    """Return which lifts of a session count; empty if lifts are independent."""
    curve = content.session
    if curve is None:
        return ""
    return (
        f", {len(curve.rmse_mm)} with each person in a row, of which the last {curve.counted} count"
    )


def curve_lines(curve: SessionCurve) -> Iterator[str]:
    """Yield what happens from the first lift of a session to the last, in lines."""
    people = curve.human_human_rmse_mm
    for label, errors in (("RMSE mm, lift by lift", curve.rmse_mm), ("two people", people or ())):
        if errors:
            yield f"{label}: {' '.join(f'{each.mean:.1f}' for each in errors)}"
    yield curve.learned


def _over(content: Results) -> str:
    """Return the name of the channel for a title; empty without one."""
    return "" if content.channel is None else f", over the channel {channel_name(content.channel)}"


def _row(strata: Sequence[StratumScore], shown: Sequence[Metric], several: bool) -> list[str]:
    """Return the cells of a row: the means over the episodes of some strata.

    ``several``: whether there are quartiles, of several people.
    """
    errors = (mean_of_strata(strata).mean, human_human_mean(strata))
    means = (metric.text(mean_of_strata(strata, metric.name).mean) for metric in shown)
    spread = spread_over_people(strata)
    between = f"{spread.lower:.1f} to {spread.upper:.1f}" if spread.people > 1 else ""
    quartiles = (between,) if several else ()
    return [*(optional_number(error, ".1f") for error in errors), *quartiles, *means]


def timing_table(report: dict[str, Any]) -> Table:
    """Return the table of a robot's latency report; see :func:`.timing_report`."""
    held = ", ".join(f"{count} x {reason}" for reason, count in report["held"].items())
    rate = report["lowest_rate_hz"]
    frames = "" if rate is None else f"frames a second: {rate:.0f} or more"
    if rate is not None and rate < LOWEST_RATE:
        frames += f", fewer than the {LOWEST_RATE:.0f} that a set-up needs"
    if report["misdated"]:
        frames += f"; {report['misdated']} left out because of their time stamps"
    if report["disordered"]:
        frames += f"; {report['disordered']} left out as repeated, overtaken or dated back"
    return table(
        "Times in ms",
        ("", "median", "p99", "largest"),
        (
            (title, *(optional_number(report[name][key], ".2f") for key in ("p50", "p99", "max")))
            for name, title in TIMES.items()
        ),
        caption=f"{counted(report['steps'], 'step')}; {report['late_steps']} periods skipped; "
        f"held: {held or 'never'}\n{frames}",
    )
