"""The comparison as files: JSON, CSV, picture and page."""

import csv
import dataclasses
import io
import json
from collections.abc import Iterator
from importlib.metadata import version
from pathlib import Path
from typing import Any

from ..results.baselines import HUMAN_HUMAN_LABEL
from .comparison import Comparison
from .html import html_page
from .scatter.png import png
from .scatter.scene import make_scene
from .standing import Scope, Standing
from .words import PICTURE_AXIS, picture_title


def comparison_json(comparison: Comparison) -> dict[str, Any]:
    """Return the content of ``compare.json``: policies in the order of their mean RMSE.

    ``policies`` are on all episodes, ``behaviours`` and ``subjects`` on a part of them each. The
    fields of a policy are those of :class:`.Standing`. Where ``decisive`` is false the episodes are
    too few for any test, and all policies have rank 1.
    """
    suite = comparison.contest.suite
    entries = {entry.name: entry for entry in comparison.contest.entries}
    policies = []
    for standing in comparison.overall.standings:
        entry = entries[standing.name]
        p50, p99 = entry.step_ms or (None, None)
        policies.append(
            {
                **_policy(standing),
                "digest": entry.digest,
                "pareto_front": standing.name in comparison.front,
                "step_ms": {"p50": p50, "p99": p99},
            }
        )
    return {
        "colift": version("colift"),
        "suite": suite.name,
        "suite_digest": suite.digest,
        "episodes": comparison.overall.episodes,
        "decisive": comparison.overall.decisive,
        "human_human": _baseline(comparison, HUMAN_HUMAN_LABEL),
        "bounds": [
            {"name": name, **_baseline(comparison, name)} for name in comparison.contest.bounds
        ],
        "policies": policies,
        "behaviours": [_part(scope) for scope in comparison.behaviours],
        "subjects": [_part(scope) for scope in comparison.subjects],
    }


def _policy(standing: Standing) -> dict[str, Any]:
    """Return a standing, its metrics among its fields."""
    fields = dataclasses.asdict(standing)
    of = fields.pop("metrics")
    empty = {"mean": None, "ci95": None}
    return fields | {
        name: (metric["estimate"] or empty) | {"missing": metric["missing"]}
        for name, metric in of.items()
    }


def _baseline(comparison: Comparison, name: str) -> dict[str, Any]:
    baseline = comparison.contest.baselines[name]
    return {
        "rmse_mm": dataclasses.asdict(comparison.overall.baselines_rmse_mm[name]),
        **{name: {"mean": mean} for name, mean in baseline.means.items()},
    }


def _part(scope: Scope) -> dict[str, Any]:
    return {
        "name": scope.name,
        "episodes": scope.episodes,
        "decisive": scope.decisive,
        "human_human_rmse_mm": dataclasses.asdict(scope.human_human_rmse_mm),
        "policies": [_policy(standing) for standing in scope.standings],
    }


def comparison_csv(comparison: Comparison) -> str:
    """Return the content of ``compare.csv``: one row for each policy in each scope.

    Where there is no value, as in the difference of the best to itself, the field is empty.
    """
    scopes = (comparison.overall, *comparison.behaviours, *comparison.subjects)
    rows = [dict(_row(scope, standing)) for scope in scopes for standing in scope.standings]
    text = io.StringIO()
    writer = csv.DictWriter(text, fieldnames=list(rows[0]), lineterminator="\n")
    writer.writeheader()
    writer.writerows(rows)
    return text.getvalue()


def _row(scope: Scope, standing: Standing) -> Iterator[tuple[str, object]]:
    yield from (("scope", scope.kind), ("name", scope.name), ("episodes", scope.episodes))
    yield from (("policy", standing.name), ("rank", standing.rank), ("failed", standing.failed))
    behind = standing.to_best
    for name, estimate in (
        ("rmse_mm", standing.rmse_mm),
        ("human_human_rmse_mm", scope.human_human_rmse_mm),
        ("vs_human", standing.vs_human),
        *((name, metric.estimate) for name, metric in standing.metrics.items()),
        ("to_best_mm", behind),
    ):
        low, high = estimate.ci95 if estimate else (None, None)
        yield name, estimate.mean if estimate else None
        yield from ((f"{name}_low", low), (f"{name}_high", high))
    yield "to_best_p", behind.p if behind else None
    yield "to_best_share_better", behind.share_better if behind else None
    yield "better_than_human", standing.better_than_human
    yield from ((f"{name}_missing", metric.missing) for name, metric in standing.metrics.items())
    yield "clipped", standing.clipped


def write_comparison(folder: Path, comparison: Comparison) -> None:
    """Write ``compare.json``, ``compare.csv``, ``compare.png`` and ``compare.html`` into a folder.

    Equal comparisons give equal files, up to the step times.

    Raises
    ------
    OSError
        If it cannot be written to.
    """
    folder.mkdir(parents=True, exist_ok=True)
    title = picture_title(comparison).splitlines()
    scene = make_scene(comparison.points, axis=PICTURE_AXIS, title=title)
    content = json.dumps(comparison_json(comparison), indent=2, allow_nan=False) + "\n"
    (folder / "compare.png").write_bytes(png(scene))
    (folder / "compare.json").write_text(content, encoding="utf-8")
    (folder / "compare.csv").write_text(comparison_csv(comparison), encoding="utf-8")
    (folder / "compare.html").write_text(html_page(comparison), encoding="utf-8")
