"""The validity of suites as tables for a terminal."""

import re
import textwrap
from collections.abc import Callable, Iterator
from typing import Final, Literal

from colift.benchmark.comparison.formatting import digits, p_value
from colift.benchmark.comparison.tables import BASELINE
from colift.benchmark.results.baselines import HUMAN_HUMAN
from colift.benchmark.tables.printing import counted, styled, table
from colift.benchmark.validity.prediction import BetterThanPeople
from colift.benchmark.validity.quantity import Quantity
from colift.benchmark.validity.report import SourceValidity, SuiteOnSource, Validity
from colift.benchmark.validity.scores import Scores
from rich.table import Table

HEADING: Final = 12
"""Longest line of a source's name above a column."""

MEANINGS: Final = (
    "Spearman, Kendall: rank correlation of the policies' mean RMSE on the suite and on the "
    "source; 1 is the same order. Of best half: Kendall among the better half of the policies on "
    "the suite. Beating people: the policies with less error than two people on the suite, and "
    "the correlations among these alone. Ratio: RMSE divided by that of two people on the same "
    "lifts. Off by: median factor between the ratios on source and suite, either way. Bias: median "
    "of the ratio on the source over that on the suite. Place, behind: of the suite's best policy, "
    "on the source; behind the best other policy, with the Holm-corrected p of the difference. In "
    "brackets: 95 % intervals, for other people where the source names them, else for other lifts "
    "of the same people."
)
"""Meaning of the lines of :func:`source_table`."""


def heading(each: SourceValidity) -> str:
    """Return the lifts of a source, and the best policy there."""
    source, best = each.source, each.winner
    return (
        f"{source.name}: {counted(source.lifts, 'lift')}, "
        f"two people {_mm(source.human_human_mm)} mm. "
        f"Best policy: {best}, {_mm(source.mean_mm(best))} mm; it is the best in "
        f"{each.best_shares[best]:.0%} of resamples.{_pairs(source, best)}"
    )


def _pairs(source: Scores, best: str) -> str:
    """Return a sentence on the recorded pairs themselves; empty if there are none."""
    beside = source.beside
    if beside is None:
        return ""
    return (
        f" The recorded pairs themselves: {_mm(beside.pairs_mm)} mm "
        f"({_interval(beside.pairs_mm)}); in the same part of the lifts, {best} has "
        f"{_quantity(beside.ratio(best))} of that, the simulated two people "
        f"{_quantity(beside.ratio(HUMAN_HUMAN))}."
    )


def source_table(each: SourceValidity) -> Table:
    """Return the quality of each suite's prediction of a source: a column per suite."""
    return table(
        "",
        ("", *(suite.suite.name for suite in each.suites)),
        ((name, *map(cell, each.suites)) for name, cell in _lines()),
    )


def _lines() -> Iterator[tuple[str, Callable[[SuiteOnSource], str]]]:
    """Yield the lines of a source's table: name, and function that returns a suite's cell."""
    yield "Spearman", lambda suite: _quantity(suite.prediction.spearman)
    yield "Kendall", lambda suite: _quantity(suite.prediction.kendall)
    yield "of best half", lambda suite: _quantity(suite.prediction.kendall_best_half)
    yield "beating people", lambda suite: _better(suite.prediction.better)
    yield "  Spearman", lambda suite: _better(suite.prediction.better, "spearman")
    yield "  Kendall", lambda suite: _better(suite.prediction.better, "kendall")
    yield "ratios off by", lambda suite: _quantity(suite.prediction.factor)
    yield "bias", lambda suite: _quantity(suite.prediction.bias)
    yield "best policy", lambda suite: suite.verdict.policy
    yield "its place", lambda suite: f"{suite.verdict.place}"
    yield "best other", lambda suite: suite.verdict.rival.name
    yield "behind, mm", lambda suite: f"{suite.verdict.behind_mm.value:.2f}"
    yield "95 %", lambda suite: _interval(suite.verdict.behind_mm)
    yield "p", lambda suite: p_value(suite.verdict.rival.p)
    yield "verdict", lambda suite: suite.verdict.judgement


def ratios_table(validity: Validity) -> Table:
    """Return the ratio of each policy to two people, and its place, on suites and sources."""
    columns = [*validity.suites, *(each.source for each in validity.sources)]
    rows = [(name, *(_ratio(scores, name) for scores in columns)) for name in validity.policies]
    baseline = ("two people, mm", *(f"{_mm(each.human_human_mm)}    " for each in columns))
    return table(
        "RMSE divided by that of two people, and place",
        ("policy", *(source_heading(each.name) for each in columns)),
        [*rows, styled(baseline, BASELINE)],
    )


def source_heading(name: str) -> str:
    """Return a name on lines that end at blanks, underscores and hyphens."""
    parts = re.sub(r"([_-])", r"\1 ", name)
    return re.sub(r"([_-]) ", r"\1", "\n".join(textwrap.wrap(parts, HEADING)))


def _ratio(scores: Scores, policy: str) -> str:
    value = scores.vs_human(policy).value
    return f"{value:.2f} {scores.place(policy):>3}"


def _mm(found: Quantity) -> str:
    return f"{found.value:{digits(found.value)}}"


def _quantity(found: Quantity) -> str:
    return f"{found.value:.2f} ({_interval(found)})"


def _better(
    found: BetterThanPeople | None, measure: Literal["spearman", "kendall"] | None = None
) -> str:
    if found is None:
        return "too few" if measure is None else ""
    if measure is None:
        return f"{len(found.policies)} policies"
    return _quantity(found.spearman if measure == "spearman" else found.kendall)


def _interval(found: Quantity) -> str:
    return f"{found.low:.2f} to {found.high:.2f}"
