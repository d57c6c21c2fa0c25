"""The comparison as one HTML file that needs nothing else."""

from collections.abc import Sequence
from importlib.metadata import version
from typing import Final

from ..episode.metric import Metric
from ..rendering.page import Cell, Row, render
from ..statistics import Estimate
from . import words
from .comparison import Comparison
from .contest import Entry
from .scatter.scene import NARROW, WIDE, make_scene
from .scatter.svg import svg
from .standing import MetricMean, Scope, Standing
from .words import between, digits, p_value, probability

AGAINST: Final = ("policy", "behind the best mm", "p", "better than the best", "better than humans")


def html_page(comparison: Comparison) -> str:
    """Return the page: picture, ranks, differences, tables by behaviour and by subject."""
    kinds = (("behaviour", comparison.behaviours), ("subject", comparison.subjects))
    return render(
        __package__,
        "compare.html",
        title=f"{words.title(comparison)}, compared",
        words=words,
        verdict=words.verdict(comparison),
        odd=(*words.failures(comparison), *words.oddities(comparison)),
        pictures=[
            svg(make_scene(comparison.points, axis=words.PICTURE_AXIS, size=size), kind)
            for kind, size in (("wide", WIDE), ("narrow", NARROW))
        ],
        ranks_header=(
            "policy",
            "rank",
            "RMSE mm",
            "vs_human",
            *(each.heading for each in comparison.contest.metrics),
            "step ms",
        ),
        ranks=_ranks(comparison),
        against_header=AGAINST,
        against=_against(comparison),
        parts=[
            {
                "kind": kind,
                "caption": words.parts_caption(kind, scopes),
                "header": ("policy", *(scope.name for scope in scopes)),
                "rows": _parts(comparison, scopes),
            }
            for kind, scopes in kinds
        ],
        provenance=words.provenance(comparison, version("colift")),
    )


def _ranks(comparison: Comparison) -> list[Row]:
    entries = {entry.name: entry for entry in comparison.contest.entries}
    rows = [_rank_row(comparison, s, entries[s.name]) for s in comparison.overall.standings]
    rows += [_baseline_row(comparison, name) for name in comparison.contest.baselines]
    return rows


def _baseline_row(comparison: Comparison, name: str) -> Row:
    baseline, overall = comparison.contest.baselines[name], comparison.overall
    rmse = overall.baselines_rmse_mm[name]
    cells = [
        Cell(""),
        _estimate(rmse, ".2f"),
        Cell(f"{rmse.mean / overall.human_human_rmse_mm.mean:.2g}"),
        *(Cell(metric.text(baseline.means[metric.name])) for metric in comparison.contest.metrics),
        Cell(""),
    ]
    return Row(name, cells, kind="baseline")


def _rank_row(comparison: Comparison, standing: Standing, entry: Entry) -> Row:
    overall, metrics = comparison.overall, comparison.contest.metrics
    steps = entry.step_ms
    return Row(
        standing.name,
        [
            Cell(str(standing.rank) if overall.decisive else "", best=overall.best(standing)),
            _estimate(standing.rmse_mm, ".2f"),
            _estimate(standing.vs_human, ".2f"),
            *(_metric(metric, standing.metrics[metric.name]) for metric in metrics),
            Cell("none") if steps is None else Cell(f"{steps[0]:.3f}", f"{steps[1]:.3f}"),
        ],
    )


def _metric(metric: Metric, mean: MetricMean) -> Cell:
    if mean.estimate is None or mean.missing:
        under = f"none in {mean.missing} lifts" if mean.estimate else ""
        return Cell(metric.text(mean.mean), under)
    return _estimate(mean.estimate, f".{metric.digits}f")


def _against(comparison: Comparison) -> list[Row]:
    rows = []
    for standing in comparison.overall.standings:
        behind, better = standing.to_best, Cell(probability(standing.better_than_human))
        if behind is None:
            cells = [Cell("best", best=True), Cell(""), Cell("")]
        else:
            cells = [
                Cell(f"{behind.mean:+.2f}", between(behind.ci95, "+.2f")),
                Cell(p_value(behind.p)),
                Cell(f"{behind.share_better:.0%}"),
            ]
        rows.append(Row(standing.name, [*cells, better]))
    return rows


def _parts(comparison: Comparison, scopes: Sequence[Scope]) -> list[Row]:
    columns = [{standing.name: standing for standing in scope.standings} for scope in scopes]
    rows = []
    for standing in comparison.overall.standings:
        parts = [
            _part(scope, column[standing.name])
            for scope, column in zip(scopes, columns, strict=True)
        ]
        rows.append(Row(standing.name, parts))
    for name in scopes[0].baselines_rmse_mm:
        means = [scope.baselines_rmse_mm[name] for scope in scopes]
        errors = [_estimate(mean, digits(mean.mean)) for mean in means]
        rows.append(Row(name, errors, kind="baseline"))
    return rows


def _part(scope: Scope, standing: Standing) -> Cell:
    behind = standing.to_best
    under = "best"
    if behind is not None:
        interval = between(behind.ci95, "+.1f")
        under = f"{behind.mean:+.1f}" + (f" ({interval})" if interval else "")
    return Cell(f"{standing.rmse_mm.mean:.1f}", under, best=scope.best(standing))


def _estimate(estimate: Estimate, digits: str) -> Cell:
    return Cell(f"{estimate.mean:{digits}}", between(estimate.ci95, digits))
