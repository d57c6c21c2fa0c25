"""A comparison as tables for a terminal."""

from typing import Final

from colift.benchmark.comparison.captions import RANK, marks_caption, title, undecided
from colift.benchmark.comparison.compare import Comparison
from colift.benchmark.comparison.formatting import between, digits, p_value, probability
from colift.benchmark.comparison.ranking import RankedPolicy, Ranking
from colift.benchmark.episode.metric import Metric
from colift.benchmark.results.baselines import BEST_KNOWN, HUMAN_HUMAN_LABEL, reference_label
from colift.benchmark.results.roughness import ROUGHER, SIGN
from colift.benchmark.statistics import Estimate
from colift.benchmark.tables.printing import Cell, counted, styled, table
from rich.table import Column, Table
from rich.text import Text

NAME: Final = 18
"""Longest name that stays on one line."""

BASELINE: Final = "blue"
"""Style of the rows of the human-human baseline and of the references."""


def ranks_table(comparison: Comparison) -> Table:
    """Return the policies by rank, the human-human baseline among them."""
    suite, overall = comparison.results.suite, comparison.overall
    rows: list[tuple[float, list[Cell]]] = [
        (ranked.rmse_mm.mean, _policy_row(comparison, ranked)) for ranked in overall.policies
    ]
    rows += [
        (overall.unranked_rmse_mm[name].mean, styled(_baseline_row(comparison, name), BASELINE))
        for name in comparison.results.unranked
    ]
    return table(
        title(comparison),
        (
            Column("#", justify="right"),
            Column("policy", overflow="fold", min_width=len(reference_label(BEST_KNOWN))),
            *("RMSE mm", "95 %", "vs_human"),
            *(each.symbol for each in comparison.results.metrics),
        ),
        (cells for _, cells in sorted(rows, key=lambda row: row[0])),
        caption=f"{counted(overall.episodes, 'lift')} each; suite digest {suite.digest}. "
        + (undecided(overall) or RANK.replace("Rank:", "#, the rank:"))
        + f" vs_human: RMSE over that of {HUMAN_HUMAN_LABEL} on the same lift, geometric mean."
        f"{_columns(comparison)}{_no_policies(comparison)}{_fewer(comparison)}{_rough(comparison)}",
    )


def _columns(comparison: Comparison) -> str:
    """Return units and meanings of the columns whose headings lack them."""
    return "".join(f" {metric.caption}" for metric in comparison.results.metrics if metric.caption)


def _no_policies(comparison: Comparison) -> str:
    """Return a sentence that names the references; empty if there are none."""
    names = [f"the {reference_label(name)}" for name in reversed([*comparison.results.references])]
    are = "are no policies but references" if len(names) > 1 else "is no policy but a reference"
    listed = " and ".join(names)
    return f" {listed[0].upper()}{listed[1:]} {are}." if names else ""


def _fewer(comparison: Comparison) -> str:
    """Return the meaning of a dagger; empty if there is none."""
    policies = comparison.overall.policies
    lifts = {
        metric.words.present: None
        for metric in comparison.results.metrics
        if any(ranked.partial(metric) for ranked in policies)
    }
    return f" †: mean over the lifts {' or '.join(lifts)}." if lifts else ""


def _rough(comparison: Comparison) -> str:
    """Return the meaning of the mark of rough policies; empty if there is none."""
    marked = any(ranked.rougher for ranked in comparison.overall.policies)
    return f" {SIGN}: {ROUGHER}." if marked else ""


def _baseline_row(comparison: Comparison, name: str) -> list[str]:
    baseline, overall = comparison.results.unranked[name], comparison.overall
    rmse = overall.unranked_rmse_mm[name]
    return [
        "",
        name,
        f"{rmse.mean:.2f}",
        _interval(rmse),
        f"{overall.unranked_vs_human[name].mean:.2g}",
        *(metric.text(baseline.means[metric.name]) for metric in comparison.results.metrics),
    ]


def _policy_row(comparison: Comparison, ranked: RankedPolicy) -> list[Cell]:
    overall, metrics = comparison.overall, comparison.results.metrics
    return [
        _rank(overall, ranked),
        policy_cell(ranked.name),
        f"{ranked.rmse_mm.mean:.2f}",
        _interval(ranked.rmse_mm),
        f"{ranked.vs_human.mean:.2f}",
        *(_metric(metric, ranked) for metric in metrics),
    ]


def _rank(overall: Ranking, ranked: RankedPolicy) -> str:
    rank = str(ranked.rank) if overall.decisive else ""
    return f"{rank} {SIGN}".lstrip() if ranked.rougher else rank


def _metric(metric: Metric, ranked: RankedPolicy) -> str:
    mean = ranked.scores.metric(metric.name).mean
    return metric.text(mean) + (" †" if ranked.partial(metric) else "")


def comparison_tables(comparison: Comparison) -> list[Table]:
    """Return all tables: ranks, differences and, of several behaviours, the error on each."""
    tables = [ranks_table(comparison), differences_table(comparison)]
    if len(comparison.behaviours) > 1:
        tables.append(behaviours_table(comparison))
    return tables


def differences_table(comparison: Comparison) -> Table:
    """Return each policy's difference to the best, and the probability that it beats two people."""
    best, *others = comparison.overall.policies
    rows = []
    for ranked in others:
        behind = ranked.to_best
        assert behind is not None
        rows.append(
            (
                policy_cell(ranked.name),
                f"{behind.mean:+.2f}",
                between(behind.ci95, "+.2f"),
                p_value(behind.p),
                f"{behind.share_better:.0%}",
                probability(ranked.better_than_human),
            )
        )
    return table(
        f"Behind {best.name}, on the same lifts",
        ("policy", "RMSE mm", "95 %", "p", "better", "P(< human)"),
        rows,
        caption="RMSE: difference to the best policy. p: of sign flips of people, corrected for "
        "all pairs. better: share of the lifts in which the policy has the lower RMSE. P(< human): "
        f"probability that vs_human is below 1 with other people; for {best.name} it is "
        f"{probability(best.better_than_human) or 'not known'}.",
    )


def behaviours_table(comparison: Comparison) -> Table:
    """Return the RMSE of each policy on each behaviour, the best of each marked."""
    rankings = comparison.behaviours
    columns = [{ranked.name: ranked for ranked in ranking.policies} for ranking in rankings]
    rows: list[list[Cell]] = [
        [policy_cell(name), *map(_mark, rankings, (column[name] for column in columns))]
        for name in (ranked.name for ranked in comparison.overall.policies)
    ]
    for name in comparison.results.unranked:
        errors = (ranking.unranked_rmse_mm[name].mean for ranking in rankings)
        cells = (f"{error:{digits(error)}}  " for error in errors)
        rows.append(styled((name, *cells), BASELINE))
    return table(
        "RMSE mm on each behaviour",
        ("policy", *(ranking.name for ranking in rankings)),
        rows,
        caption=marks_caption("*", rankings),
    )


def _mark(ranking: Ranking, ranked: RankedPolicy) -> Text:
    mean = f"{ranked.rmse_mm.mean:.1f}"
    return Text(f"{mean} *", "bold") if ranking.best(ranked) else Text(f"{mean}  ")


def policy_cell(name: str) -> str:
    """Return a policy's name, its parameters on lines of their own if it is long."""
    return name if len(name) <= NAME else name.replace(",", ",\n ")


def _interval(estimate: Estimate) -> str:
    return between(estimate.ci95, digits(estimate.mean))
