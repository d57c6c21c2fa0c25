"""The content of ``results.json``."""

from collections.abc import Mapping
from importlib.metadata import version
from typing import Any

from ..references import HUMAN_HUMAN, Reference
from ..runner import Run
from ..scores import SCORING
from ..statistics import stratified_bootstrap
from ..suite import Suite
from ..summary import group, summarise


def results(run: Run, references: Mapping[str, Reference]) -> dict[str, Any]:
    """Return the content of ``results.json``.

    Everything follows from the episodes, but for what :func:`with_circumstances` names.

    Parameters
    ----------
    run
        The policy's episodes.
    references
        Other agents on the same episodes, by name; see :mod:`colift.benchmark.references`.
    """
    team = references.get(HUMAN_HUMAN)
    summary = summarise(run.episodes, team.rmse_mm if team else None)
    summary["real_time"] = real_time(summary["step_ms"]["p99"], run.suite)
    return {
        "colift": version("colift"),
        "suite": run.suite.name,
        "suite_digest": run.suite.digest,
        "scoring": SCORING,
        "complete": run.complete,
        "policy": {"name": run.policy, "digest": run.policy_digest},
        "isolation": run.isolation,
        "evaluator_faults": run.faults,
        "summary": summary,
        "groups": group(run.episodes, team.by_cell() if team else None),
        "references": {name: _reference(value) for name, value in references.items()},
    }


def real_time(p99_ms: float | None, suite: Suite) -> bool | None:
    """Return whether a policy keeps up with a real robot; None if it never acted.

    It does if the 99th percentile of its time per step [ms] is below the control period.
    """
    if p99_ms is None:
        return None
    return p99_ms < 1000 * min(scenario.control_period for scenario in suite.scenarios)


def with_circumstances(
    content: dict[str, Any], claimed: Mapping[str, Any], suite: Suite
) -> dict[str, Any]:
    """Return the content with the circumstances of another: what no simulation can tell.

    They are the version of colift that wrote it, and the policy's times per step. (The policy's
    name and digest, the isolation and the faults come with the run.)
    """
    step_ms = claimed["summary"]["step_ms"]
    timed = {"step_ms": step_ms, "real_time": real_time(step_ms["p99"], suite)}
    return {
        **content,
        "colift": claimed["colift"],
        "summary": {**content["summary"], **timed},
    }


def _reference(reference: Reference) -> dict[str, Any]:
    return {
        "rmse_mm": {
            "mean": reference.mean,
            "ci95": list(stratified_bootstrap(reference.rmse_mm, reference.cells)),
        },
        "sparc": {"mean": reference.sparc},
        "human_force_n": {"mean": reference.human_force_n},
    }
