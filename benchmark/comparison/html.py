"""The comparison as one HTML file that needs nothing else."""

from collections.abc import Sequence
from importlib.metadata import version
from typing import Final

from colift.benchmark.comparison import captions
from colift.benchmark.comparison.compare import Comparison
from colift.benchmark.comparison.formatting import between, digits, p_value, probability
from colift.benchmark.comparison.paired_results import PolicyResults
from colift.benchmark.comparison.ranking import RankedPolicy, Ranking
from colift.benchmark.comparison.scatter.scene import NARROW, WIDE, make_scene
from colift.benchmark.comparison.scatter.svg import svg
from colift.benchmark.episode.metric import Metric
from colift.benchmark.rendering.page import Cell, Row, render
from colift.benchmark.results.roughness import ROUGHER
from colift.benchmark.statistics import Estimate

AGAINST: Final = ("policy", "behind the best mm", "p", "lifts won", "P(better than humans)")


def html_page(comparison: Comparison) -> str:
    """Return the page: picture, ranks, differences, tables by behaviour and by subject.

    If each behaviour has one subject of its own, both tables would have the same numbers.
    """
    kinds = [("behaviour", comparison.behaviours)]
    if comparison.subjects and not comparison.one_each:
        kinds.append(("subject", comparison.subjects))
    axes = comparison.results.axes
    axis = captions.picture_axis(axes)
    return render(
        __package__,
        "compare.html",
        title=f"{captions.title(comparison)}, compared",
        captions=captions,
        picture_caption=captions.picture_caption(axes, comparison.front),
        how_to_read=captions.how_to_read(axes),
        verdict=captions.verdict(comparison),
        warnings=(
            *captions.goals(comparison),
            *captions.failures(comparison),
            *captions.roughness(comparison),
            *captions.unit_warnings(comparison),
        ),
        pictures=[
            svg(make_scene(comparison.points, axes, axis=axis, size=size), kind)
            for kind, size in (("wide", WIDE), ("narrow", NARROW))
        ],
        ranks_header=(
            "policy",
            "rank",
            "RMSE mm",
            "vs_human",
            *(each.heading for each in comparison.results.metrics),
            "step ms",
        ),
        ranks=_ranks(comparison),
        against_header=AGAINST,
        against=_against(comparison),
        parts=[
            {
                "kind": kind,
                "caption": captions.parts_caption(kind, rankings),
                "header": ("policy", *(ranking.name for ranking in rankings)),
                "rows": _parts(comparison, rankings),
            }
            for kind, rankings in kinds
        ],
        provenance=captions.provenance(comparison, version("colift")),
    )


def _ranks(comparison: Comparison) -> list[Row]:
    by_name = {policy.name: policy for policy in comparison.results.policies}
    rows = [_policy_row(comparison, s, by_name[s.name]) for s in comparison.overall.policies]
    rows += [_baseline_row(comparison, name) for name in comparison.results.unranked]
    return rows


def _baseline_row(comparison: Comparison, name: str) -> Row:
    baseline, overall = comparison.results.unranked[name], comparison.overall
    rmse = overall.unranked_rmse_mm[name]
    cells = [
        Cell(""),
        _estimate(rmse, ".2f"),
        Cell(f"{overall.unranked_vs_human[name].mean:.2g}"),
        *(Cell(metric.text(baseline.means[metric.name])) for metric in comparison.results.metrics),
        Cell(""),
    ]
    return Row(name, cells, kind="baseline")


def _policy_row(comparison: Comparison, ranked: RankedPolicy, policy: PolicyResults) -> Row:
    overall, metrics = comparison.overall, comparison.results.metrics
    steps = policy.step_ms
    return Row(
        ranked.name,
        [
            _rank(overall, ranked),
            _estimate(ranked.rmse_mm, ".2f"),
            _estimate(ranked.vs_human, ".2f"),
            *(_metric(metric, ranked) for metric in metrics),
            Cell("none") if steps.p50 is None else Cell(f"{steps.p50:.3f}", f"{steps.p99:.3f}"),
        ],
    )


def _rank(overall: Ranking, ranked: RankedPolicy) -> Cell:
    rank = str(ranked.rank) if overall.decisive else ""
    return Cell(rank, ROUGHER if ranked.rougher else "", best=overall.best(ranked))


def _metric(metric: Metric, ranked: RankedPolicy) -> Cell:
    estimate, found = ranked.metrics[metric.name], ranked.scores.metric(metric.name)
    if estimate is None or found.missing:
        under = f"none in {found.missing} lifts" if estimate else ""
        return Cell(metric.text(found.mean), under)
    return _estimate(estimate, f".{metric.digits}f")


def _against(comparison: Comparison) -> list[Row]:
    rows = []
    for ranked in comparison.overall.policies:
        behind, better = ranked.to_best, Cell(probability(ranked.better_than_human))
        if behind is None:
            cells = [Cell("best", best=True), Cell(""), Cell("")]
        else:
            cells = [
                Cell(f"{behind.mean:+.2f}", between(behind.ci95, "+.2f")),
                Cell(p_value(behind.p)),
                Cell(f"{behind.share_better:.0%}"),
            ]
        rows.append(Row(ranked.name, [*cells, better]))
    return rows


def _parts(comparison: Comparison, rankings: Sequence[Ranking]) -> list[Row]:
    columns = [{ranked.name: ranked for ranked in ranking.policies} for ranking in rankings]
    rows = []
    for ranked in comparison.overall.policies:
        parts = [
            _part(ranking, column[ranked.name])
            for ranking, column in zip(rankings, columns, strict=True)
        ]
        rows.append(Row(ranked.name, parts))
    for name in rankings[0].unranked_rmse_mm:
        means = [ranking.unranked_rmse_mm[name] for ranking in rankings]
        errors = [_estimate(mean, digits(mean.mean)) for mean in means]
        rows.append(Row(name, errors, kind="baseline"))
    return rows


def _part(ranking: Ranking, ranked: RankedPolicy) -> Cell:
    behind = ranked.to_best
    under = "best"
    if behind is not None:
        interval = between(behind.ci95, "+.1f")
        under = f"{behind.mean:+.1f}" + (f" ({interval})" if interval else "")
    return Cell(f"{ranked.rmse_mm.mean:.1f}", under, best=ranking.best(ranked))


def _estimate(estimate: Estimate, digits: str) -> Cell:
    return Cell(f"{estimate.mean:{digits}}", between(estimate.ci95, digits))
