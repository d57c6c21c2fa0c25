"""The comparison as files: JSON, CSV, page, figures, and a table of LaTeX with what to cite."""

import csv
import dataclasses
import io
import json
from collections.abc import Iterator
from importlib.metadata import version
from pathlib import Path
from typing import Any

from colift.benchmark.channels.recorded import recorded
from colift.benchmark.comparison.captions import picture_axis, picture_title
from colift.benchmark.comparison.compare import Comparison
from colift.benchmark.comparison.html import html_page
from colift.benchmark.comparison.lifts_figure import lifts_figure
from colift.benchmark.comparison.ranking import RankedPolicy, Ranking
from colift.benchmark.comparison.ranks_figure import ranks_figure
from colift.benchmark.comparison.scatter.figure import scatter_figure, scene_size
from colift.benchmark.comparison.scatter.scene import make_scene
from colift.benchmark.comparison.tex import comparison_tex
from colift.benchmark.rendering.figures import drawn_for, write_all
from colift.benchmark.rendering.layout import PAGE, Layout
from colift.benchmark.results.baselines import HUMAN_HUMAN_LABEL, reference_label
from colift.benchmark.results.citation import bibtex
from colift.benchmark.results.goals import goal_scores
from colift.benchmark.suites.treatments import plain_treatments
from matplotlib.figure import Figure


def comparison_json(comparison: Comparison) -> dict[str, Any]:
    """Return the content of ``compare.json``: policies in the order of their mean RMSE.

    ``policies`` covers all episodes; each of ``behaviours`` and ``subjects`` covers a part of them.
    A policy has the numbers of :class:`.RankedPolicy`. Where ``decisive`` is false, the
    people are too few for any test, and all policies have rank 1. ``recordings`` is there if the
    suite has some: the sampling of each trial, and the changes to it.
    """
    suite = comparison.results.suite
    by_name = {policy.name: policy for policy in comparison.results.policies}
    policies = []
    for ranked in comparison.overall.policies:
        policy = by_name[ranked.name]
        policies.append(
            {
                **_policy(ranked),
                "digest": policy.digest,
                "pareto_front": ranked.name in comparison.front,
                "step_ms": dataclasses.asdict(policy.step_ms),
            }
        )
    channel, goals = comparison.results.channel, goal_scores(suite)
    recordings = plain_treatments(suite)
    return {
        "colift": version("colift"),
        **({} if channel is None else {"channel": recorded(channel)}),
        "suite": suite.name,
        "suite_digest": suite.digest,
        **({} if goals is None else {"goals": goals.plain()}),
        "episodes": comparison.overall.episodes,
        **({"recordings": recordings} if recordings else {}),
        "decisive": comparison.overall.decisive,
        "human_human": _baseline(comparison, HUMAN_HUMAN_LABEL),
        "references": [
            {"name": name, **_baseline(comparison, reference_label(name))}
            for name in comparison.results.references
        ],
        "policies": policies,
        "behaviours": [_part(ranking) for ranking in comparison.behaviours],
        "subjects": [_part(ranking) for ranking in comparison.subjects],
    }


def _policy(ranked: RankedPolicy) -> dict[str, Any]:
    """Return a ranked policy, its metrics among its fields."""
    to_best = ranked.to_best
    return {
        "name": ranked.name,
        "rank": ranked.rank,
        "failed": ranked.failed,
        "rmse_mm": dataclasses.asdict(ranked.rmse_mm),
        "vs_human": dataclasses.asdict(ranked.vs_human),
        "better_than_human": ranked.better_than_human,
        "rougher": None if ranked.rougher is None else list(ranked.rougher),
        "clipped": ranked.clipped,
        "to_best": None if to_best is None else dataclasses.asdict(to_best),
        **{
            name: (dataclasses.asdict(estimate) if estimate else {"mean": None, "ci95": None})
            | {"missing": ranked.scores.metric(name).missing}
            for name, estimate in ranked.metrics.items()
        },
    }


def _baseline(comparison: Comparison, name: str) -> dict[str, Any]:
    baseline = comparison.results.unranked[name]
    return {
        "rmse_mm": dataclasses.asdict(comparison.overall.unranked_rmse_mm[name]),
        **{name: {"mean": mean} for name, mean in baseline.means.items()},
    }


def _part(ranking: Ranking) -> dict[str, Any]:
    return {
        "name": ranking.name,
        "episodes": ranking.episodes,
        "decisive": ranking.decisive,
        "human_human_rmse_mm": dataclasses.asdict(ranking.human_human_rmse_mm),
        "policies": [_policy(ranked) for ranked in ranking.policies],
    }


def comparison_rows(comparison: Comparison) -> list[dict[str, object]]:
    """Return one row for each policy in each ranking: on all lifts, by behaviour, by subject.

    Where there is no value, as in the difference of the best to itself, it is None.
    """
    rankings = (comparison.overall, *comparison.behaviours, *comparison.subjects)
    return [dict(_row(ranking, ranked)) for ranking in rankings for ranked in ranking.policies]


def comparison_csv(comparison: Comparison) -> str:
    """Return the content of ``compare.csv``: the rows, where a field without a value is empty."""
    rows = comparison_rows(comparison)
    text = io.StringIO()
    writer = csv.DictWriter(text, fieldnames=list(rows[0]), lineterminator="\n")
    writer.writeheader()
    writer.writerows(rows)
    return text.getvalue()


def _row(ranking: Ranking, ranked: RankedPolicy) -> Iterator[tuple[str, object]]:
    yield from (("scope", ranking.kind), ("name", ranking.name), ("episodes", ranking.episodes))
    yield from (("policy", ranked.name), ("rank", ranked.rank), ("failed", ranked.failed))
    behind = ranked.to_best
    for name, estimate in (
        ("rmse_mm", ranked.rmse_mm),
        ("human_human_rmse_mm", ranking.human_human_rmse_mm),
        ("vs_human", ranked.vs_human),
        *ranked.metrics.items(),
        ("to_best_mm", behind),
    ):
        low, high = (estimate and estimate.ci95) or (None, None)
        yield name, estimate.mean if estimate else None
        yield from ((f"{name}_low", low), (f"{name}_high", high))
    yield "to_best_p", behind.p if behind else None
    yield "to_best_share_better", behind.share_better if behind else None
    yield "better_than_human", ranked.better_than_human
    yield "rougher", None if ranked.rougher is None else " ".join(ranked.rougher)
    yield from ((f"{name}_missing", ranked.scores.metric(name).missing) for name in ranked.metrics)
    yield "clipped", ranked.clipped


def write_comparison(folder: Path, comparison: Comparison, layout: Layout = PAGE) -> None:
    """Write a comparison into a folder.

    These are ``compare.html``, ``compare.json`` and ``compare.csv``; the figures ``compare``,
    ``ranks`` and, with sessions, ``lifts``, as PNG, SVG and PDF; the table ``compare.tex``, and
    ``compare.bib``, what to cite. Equal comparisons give equal files, up to the step times.

    Parameters
    ----------
    folder
        A folder, which is made if it is not there.
    comparison
        The comparison.
    layout
        Size of figures and table. Figures have a title on a slide alone: in print it is a caption.

    Raises
    ------
    OSError
        If it cannot be written to.
    """
    folder.mkdir(parents=True, exist_ok=True)
    texts = {
        "compare.json": json.dumps(comparison_json(comparison), indent=2, allow_nan=False) + "\n",
        "compare.csv": comparison_csv(comparison),
        "compare.html": html_page(comparison),
        "compare.tex": comparison_tex(comparison, layout),
        "compare.bib": bibtex(comparison.results.suite),
    }
    for name, text in texts.items():
        (folder / name).write_text(text, encoding="utf-8")
    for name, figure in comparison_figures(comparison, layout).items():
        write_all(folder, name, figure, picture_title(comparison))


def comparison_figures(comparison: Comparison, layout: Layout) -> dict[str, Figure]:
    """Return the figures of a comparison by the names of their files."""
    axes = comparison.results.axes
    scene = make_scene(
        comparison.points,
        axes,
        axis=picture_axis(axes),
        size=scene_size(layout),
        title=() if layout.height is None else [picture_title(comparison)],
    )
    with drawn_for(layout):
        figures = {
            "compare": scatter_figure(scene, layout),
            "ranks": ranks_figure(comparison, layout),
        }
        if comparison.results.suite.session:
            figures["lifts"] = lifts_figure(comparison, layout)
        return figures
