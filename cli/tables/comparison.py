"""A comparison as a person reads it in a terminal."""

from typing import Final

from rich.table import Column, Table
from rich.text import Text

from ...benchmark.comparison.comparison import Comparison
from ...benchmark.comparison.standing import MetricMean, Scope, Standing
from ...benchmark.comparison.words import (
    between,
    digits,
    marks_caption,
    p_value,
    probability,
    title,
    undecided,
)
from ...benchmark.episode.metric import Metric
from ...benchmark.results.baselines import HUMAN_HUMAN_LABEL
from ...benchmark.statistics import Estimate
from ..printing import Cell, styled, table

NAME: Final = 18
"""Longest name that stays on one line."""

FEWER: Final = "†: over the lifts in which the robot moves along."

NO_POLICIES: Final = "The oracle and the causal bound are no policies: how far one might come."

BASELINE: Final = "blue"
"""Style of the rows of the human-human baseline and of the bounds."""


def ranks_table(comparison: Comparison) -> Table:
    """Return the policies by rank, the human-human baseline among them."""
    suite, overall = comparison.contest.suite, comparison.overall
    rows: list[tuple[float, list[Cell]]] = [
        (standing.rmse_mm.mean, _rank_row(comparison, standing)) for standing in overall.standings
    ]
    rows += [
        (overall.baselines_rmse_mm[name].mean, styled(_baseline_row(comparison, name), BASELINE))
        for name in comparison.contest.baselines
    ]
    return table(
        title(comparison),
        (
            Column("#", justify="right"),
            Column("policy", overflow="fold", min_width=len(HUMAN_HUMAN_LABEL)),
            *("RMSE mm", "95 %", "vs_human"),
            *(each.symbol for each in comparison.contest.metrics),
        ),
        (cells for _, cells in sorted(rows, key=lambda row: row[0])),
        caption=f"{overall.episodes} lifts each; suite digest {suite.digest}. "
        + (undecided(overall) or "Policies of one rank (#) cannot be told from the first of them.")
        + f" vs_human: RMSE over the {HUMAN_HUMAN_LABEL}'s. Force at the human's hands in N."
        + (f" {NO_POLICIES}" if comparison.contest.bounds else "")
        + (f" {FEWER}" if any(s.sparc and s.sparc_missing for s in overall.standings) else ""),
    )


def _baseline_row(comparison: Comparison, name: str) -> list[str]:
    baseline, overall = comparison.contest.baselines[name], comparison.overall
    rmse = overall.baselines_rmse_mm[name]
    return [
        "",
        name,
        f"{rmse.mean:.2f}",
        _interval(rmse),
        f"{rmse.mean / overall.human_human_rmse_mm.mean:.2g}",
        *(metric.text(baseline.means[metric.name]) for metric in comparison.contest.metrics),
    ]


def _rank_row(comparison: Comparison, standing: Standing) -> list[Cell]:
    overall, metrics = comparison.overall, comparison.contest.metrics
    return [
        str(standing.rank) if overall.decisive else "",
        _name(standing.name),
        f"{standing.rmse_mm.mean:.2f}",
        _interval(standing.rmse_mm),
        f"{standing.vs_human.mean:.2f}",
        *(_metric(metric, standing.metrics[metric.name]) for metric in metrics),
    ]


def _metric(metric: Metric, mean: MetricMean) -> str:
    partial = metric.missing == "worst" and mean.estimate and mean.missing
    return metric.text(mean.mean) + (" †" if partial else "")


def differences_table(comparison: Comparison) -> Table:
    """Return how far each policy is behind the best, and how sure it beats two people."""
    best, *others = comparison.overall.standings
    rows = []
    for standing in others:
        behind = standing.to_best
        assert behind is not None
        rows.append(
            (
                _name(standing.name),
                f"{behind.mean:+.2f}",
                between(behind.ci95, "+.2f"),
                p_value(behind.p),
                f"{behind.share_better:.0%}",
                probability(standing.better_than_human),
            )
        )
    return table(
        f"Behind {best.name}, on the same lifts",
        ("policy", "RMSE mm", "95 %", "p", "better", "P(< human)"),
        rows,
        caption="RMSE: difference to the best policy. p: of its permutation test, Holm-corrected. "
        "better: share of the lifts in which the policy has the lower RMSE. P(< human): "
        f"probability that its mean RMSE is below the {HUMAN_HUMAN_LABEL}'s; for {best.name} it is "
        f"{probability(best.better_than_human)}.",
    )


def behaviours_table(comparison: Comparison) -> Table:
    """Return the RMSE of each policy on each behaviour, the best of each marked."""
    scopes = comparison.behaviours
    columns = [{standing.name: standing for standing in scope.standings} for scope in scopes]
    rows: list[list[Cell]] = [
        [_name(name), *map(_mark, scopes, (column[name] for column in columns))]
        for name in (standing.name for standing in comparison.overall.standings)
    ]
    for name in comparison.contest.baselines:
        errors = (scope.baselines_rmse_mm[name].mean for scope in scopes)
        cells = (f"{error:{digits(error)}}  " for error in errors)
        rows.append(styled((name, *cells), BASELINE))
    return table(
        "RMSE mm on each behaviour",
        ("policy", *(scope.name for scope in scopes)),
        rows,
        caption=marks_caption("*", scopes),
    )


def _mark(scope: Scope, standing: Standing) -> Text:
    mean = f"{standing.rmse_mm.mean:.1f}"
    return Text(f"{mean} *", "bold") if scope.best(standing) else Text(f"{mean}  ")


def _name(name: str) -> str:
    """Return a policy's name, its parameters on lines of their own if it is long."""
    return name if len(name) <= NAME else name.replace(",", ",\n ")


def _interval(estimate: Estimate) -> str:
    return between(estimate.ci95, digits(estimate.mean))
