"""The ranks as a table of LaTeX, with the rules of the package booktabs."""

import re
from collections.abc import Iterator
from importlib.metadata import version
from typing import Final

from colift.base.tex import tex
from colift.benchmark.comparison.captions import people_text, provenance, title
from colift.benchmark.comparison.compare import Comparison
from colift.benchmark.comparison.ranking import RankedPolicy
from colift.benchmark.episode.metric import Metric
from colift.benchmark.rendering.layout import Layout
from colift.benchmark.results.roughness import ROUGHER
from colift.benchmark.statistics import Estimate

ROUGH: Final = r"$^\ddagger$"
FEWER: Final = r"^\dagger"
NONE: Final = "--"

SPANNING: Final = ("RMSE [mm]", r"$\times$ two people")
"""Headings of a number with its interval."""


def comparison_tex(comparison: Comparison, layout: Layout) -> str:
    """Return the content of ``compare.tex``: a floating table, its caption and its label.

    In a column it has ranks, errors and their ratio to two people; otherwise also the other metrics
    that comparisons show. Numbers are plain text, and names are escaped.
    """
    metrics = () if layout.narrow else comparison.results.metrics
    kind = "table" if layout.narrow else "table*"
    heads = ["", "policy", *(rf"\multicolumn{{2}}{{c}}{{{each}}}" for each in SPANNING)]
    heads += [tex(f"{each.symbol} [{each.unit}]" if each.unit else each.symbol) for each in metrics]
    overall = comparison.overall
    rows = [
        *(_policy(comparison, ranked, metrics) for ranked in overall.policies),
        [r"\midrule"],
        *(_unranked(comparison, name, metrics) for name in comparison.results.unranked),
    ]
    lines = [
        f"% {provenance(comparison, version('colift'))}",
        r"% In the preamble: \usepackage{booktabs}. What to cite is in compare.bib.",
        rf"\begin{{{kind}}}[t]",
        r"\centering",
        rf"\caption{{{' '.join(_caption(comparison, metrics))}}}",
        rf"\label{{tab:{re.sub('[^a-zA-Z0-9.-]', '-', comparison.results.suite.name)}}}",
        r"\footnotesize",
        r"\setlength{\tabcolsep}{3pt}",
        rf"\begin{{tabular}}{{@{{}}rl rl rl {'r' * len(metrics)}@{{}}}}",
        r"\toprule",
        f"{' & '.join(heads)} \\\\",
        r"\midrule",
        *(cells[0] if len(cells) == 1 else f"{' & '.join(cells)} \\\\" for cells in rows),
        r"\bottomrule",
        r"\end{tabular}",
        rf"\end{{{kind}}}",
    ]
    return "\n".join(lines) + "\n"


def _policy(comparison: Comparison, ranked: RankedPolicy, metrics: tuple[Metric, ...]) -> list[str]:
    overall = comparison.overall
    mean = f"{ranked.rmse_mm.mean:.2f}"
    return [
        str(ranked.rank) if overall.decisive else "",
        tex(ranked.name) + (ROUGH if ranked.rougher else ""),
        rf"\textbf{{{mean}}}" if overall.best(ranked) else mean,
        _interval(ranked.rmse_mm),
        f"{ranked.vs_human.mean:.2f}",
        _interval(ranked.vs_human),
        *(_metric(each, ranked) for each in metrics),
    ]


def _unranked(comparison: Comparison, name: str, metrics: tuple[Metric, ...]) -> list[str]:
    overall, baseline = comparison.overall, comparison.results.unranked[name]
    rmse = overall.unranked_rmse_mm[name]
    return [
        "",
        tex(name),
        f"{rmse.mean:.2f}",
        _interval(rmse),
        f"{overall.unranked_vs_human[name].mean:.2g}",
        "",
        *(_number(each, baseline.means[each.name]) for each in metrics),
    ]


def _metric(metric: Metric, ranked: RankedPolicy) -> str:
    mark = FEWER if ranked.partial(metric) else ""
    return _number(metric, ranked.scores.metric(metric.name).mean, mark)


def _number(metric: Metric, value: float | None, mark: str = "") -> str:
    return NONE if value is None else f"${value:.{metric.digits}f}{mark}$"


def _interval(estimate: Estimate) -> str:
    low, high = estimate.ends
    return f"[{low:.2f}, {high:.2f}]" if high > low else ""


def _caption(comparison: Comparison, metrics: tuple[Metric, ...]) -> Iterator[str]:
    overall, (leading, _) = comparison.overall, comparison.results.axes
    shown = overall.policies
    yield tex(f"{title(comparison)}: {overall.episodes} lifts with {overall.people} people.")
    yield tex(f"{leading.axis.rpartition(',')[0]}, and its ratio to that of two people on the same")
    yield r"lift (geometric mean), with 95\,\% intervals for other people."
    if overall.decisive:
        yield "Before the names: ranks, 1 + the number of policies that are better beyond chance."
        yield "Bold: none is better."
    else:
        yield f"No ranks: {people_text(overall.people)} too few for differences beyond chance."
    yield from (tex(each.caption) for each in metrics if each.caption)
    if any(ranked.rougher for ranked in shown):
        yield f"{ROUGH}: {ROUGHER}."
    if any(ranked.partial(each) for each in metrics for ranked in shown):
        yield f"${FEWER}$: mean over the lifts that have a value."
