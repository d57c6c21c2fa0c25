"""The comparison as numbers: JSON, and one row a policy and scope."""

import csv
import dataclasses
import io
from collections.abc import Iterator
from importlib.metadata import version
from typing import Any

from .comparison import Comparison
from .contest import TEAM
from .standing import Scope, Standing


def comparison_json(comparison: Comparison) -> dict[str, Any]:
    """Return the content of ``compare.json``: policies in the order of their mean RMSE.

    ``policies`` are on all episodes, ``behaviours`` and ``subjects`` on a part of them each. The
    fields of a policy are those of :class:`.Standing`.
    """
    suite = comparison.contest.suite
    entries = {entry.name: entry for entry in comparison.contest.entries}
    policies = []
    for standing in comparison.overall.standings:
        entry = entries[standing.name]
        p50, p99 = entry.step_ms or (None, None)
        policies.append(
            {
                **dataclasses.asdict(standing),
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
        "human_human": _reference(comparison, TEAM),
        "bounds": [
            {"name": name, **_reference(comparison, name)} for name in comparison.contest.bounds
        ],
        "policies": policies,
        "behaviours": [_part(scope) for scope in comparison.behaviours],
        "subjects": [_part(scope) for scope in comparison.subjects],
    }


def _reference(comparison: Comparison, name: str) -> dict[str, Any]:
    reference = comparison.contest.references[name]
    return {
        "rmse_mm": dataclasses.asdict(comparison.overall.references_rmse_mm[name]),
        "sparc": {"mean": reference.sparc},
        "human_force_n": {"mean": reference.human_force_n},
    }


def _part(scope: Scope) -> dict[str, Any]:
    return {
        "name": scope.name,
        "episodes": scope.episodes,
        "human_human_rmse_mm": dataclasses.asdict(scope.team_rmse_mm),
        "policies": [dataclasses.asdict(standing) for standing in scope.standings],
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
        ("human_human_rmse_mm", scope.team_rmse_mm),
        ("vs_human", standing.vs_human),
        ("sparc", standing.sparc),
        ("to_best_mm", behind),
    ):
        low, high = estimate.ci95 if estimate else (None, None)
        yield name, estimate.mean if estimate else None
        yield from ((f"{name}_low", low), (f"{name}_high", high))
    yield "to_best_p", behind.p if behind else None
    yield "to_best_share_better", behind.share_better if behind else None
    yield "better_than_human", standing.better_than_human
    yield "sparc_missing", standing.sparc_missing
    yield "human_force_n", standing.human_force_n
