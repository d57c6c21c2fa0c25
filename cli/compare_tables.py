"""A comparison as a person reads it in a terminal."""

from typing import Final

from rich import box
from rich.table import Table

from ..benchmark.comparison.comparison import Comparison
from ..benchmark.comparison.contest import TEAM, Entry
from ..benchmark.comparison.standing import Estimate, Standing
from ..benchmark.comparison.words import between, p_value, probability, title

NAME: Final = 18
"""Longest name that stays on one line."""

FEWER: Final = "*: over the lifts in which the robot moves along."

NO_POLICIES: Final = "The oracle and the causal bound are no policies: how far one might come."

REFERENCE: Final = "blue"
"""Style of the rows of the human-human team and of the bounds."""


def ranks_table(comparison: Comparison) -> Table:
    """Return the policies by rank, the human-human team among them."""
    suite, overall = comparison.contest.suite, comparison.overall
    table = _table(
        title(comparison),
        f"{overall.episodes} lifts each; suite digest {suite.digest}. Policies of one rank (#) "
        f"cannot be told from the first of them. vs_human: RMSE over the {TEAM}'s. Force at the "
        "human's hands in N; median time of a step in ms."
        + (f" {NO_POLICIES}" if comparison.contest.bounds else "")
        + (f" {FEWER}" if any(s.sparc and s.sparc_missing for s in overall.standings) else ""),
    )
    table.add_column("#", justify="right")
    table.add_column("policy", overflow="fold", min_width=len(TEAM))
    for name in ("RMSE mm", "95 %", "vs_human", "SPARC", "force", "step"):
        table.add_column(name, justify="right", no_wrap=True)
    entries = {entry.name: entry for entry in comparison.contest.entries}
    rows = [
        (standing.rmse_mm.mean, _rank_row(standing, entries[standing.name]), "")
        for standing in overall.standings
    ]
    rows += [
        (overall.references_rmse_mm[name].mean, _reference_row(comparison, name), REFERENCE)
        for name in comparison.contest.references
    ]
    for _, cells, style in sorted(rows, key=lambda row: row[0]):
        table.add_row(*cells, style=style)
    return table


def _reference_row(comparison: Comparison, name: str) -> list[str]:
    reference, overall = comparison.contest.references[name], comparison.overall
    rmse = overall.references_rmse_mm[name]
    return [
        "",
        name,
        f"{rmse.mean:.2f}",
        _interval(rmse),
        f"{rmse.mean / overall.team_rmse_mm.mean:.2g}",
        _number(reference.sparc, ".2f"),
        f"{reference.human_force_n:.2f}",
        "",
    ]


def _rank_row(standing: Standing, entry: Entry) -> list[str]:
    smooth = _number(standing.sparc.mean if standing.sparc else None, ".2f")
    return [
        str(standing.rank),
        _name(entry.name),
        f"{standing.rmse_mm.mean:.2f}",
        _interval(standing.rmse_mm),
        f"{standing.vs_human.mean:.2f}",
        f"{smooth} *" if standing.sparc and standing.sparc_missing else smooth,
        _number(standing.human_force_n, ".2f"),
        _number(entry.step_ms[0] if entry.step_ms else None, ".3f"),
    ]


def differences_table(comparison: Comparison) -> Table:
    """Return how far each policy is behind the best, and how sure it beats two people."""
    best, *others = comparison.overall.standings
    table = _table(
        f"Behind {best.name}, on the same lifts",
        "p: of no difference, Holm-corrected. better: share of the lifts. P(< human): that its "
        f"mean error is below the {TEAM}'s; {probability(best.better_than_human)} for "
        f"{best.name}.",
    )
    table.add_column("policy", overflow="fold")
    for name in ("RMSE mm", "95 %", "p", "better", "P(< human)"):
        table.add_column(name, justify="right", no_wrap=True)
    for standing in others:
        behind = standing.to_best
        assert behind is not None
        table.add_row(
            _name(standing.name),
            f"{behind.mean:+.2f}",
            between(behind.ci95, "+.2f"),
            p_value(behind.p),
            f"{behind.share_better:.0%}",
            probability(standing.better_than_human),
        )
    return table


def behaviours_table(comparison: Comparison) -> Table:
    """Return the RMSE of each policy on each behaviour, the best of each marked."""
    table = _table(
        "RMSE mm on each behaviour",
        "1: the best on the behaviour, and those that cannot be told from it.",
    )
    table.add_column("policy", overflow="fold")
    columns = []
    for scope in comparison.behaviours:
        table.add_column(scope.name, justify="right", no_wrap=True)
        columns.append({standing.name: standing for standing in scope.standings})
    for standing in comparison.overall.standings:
        table.add_row(_name(standing.name), *(_mark(column[standing.name]) for column in columns))
    for name in comparison.contest.references:
        errors = [scope.references_rmse_mm[name].mean for scope in comparison.behaviours]
        table.add_row(name, *(f"{error:.1f}  " for error in errors), style=REFERENCE)
    return table


def _mark(standing: Standing) -> str:
    told = f"{standing.rmse_mm.mean:.1f}"
    return f"[bold]{told} 1[/]" if standing.rank == 1 else f"{told}  "


def _table(name: str, caption: str) -> Table:
    return Table(
        title=name,
        caption=caption,
        title_justify="left",
        caption_justify="left",
        box=box.SIMPLE_HEAD,
        padding=(0, 0, 0, 1),
    )


def _name(name: str) -> str:
    """Return a policy's name, its parameters on lines of their own if it is long."""
    return name if len(name) <= NAME else name.replace(",", ",\n ")


def _interval(estimate: Estimate) -> str:
    return between(estimate.ci95, ".1f" if estimate.ci95[1] < 100 else ".0f")


def _number(value: float | None, digits: str) -> str:
    return "none" if value is None else f"{value:{digits}}"
