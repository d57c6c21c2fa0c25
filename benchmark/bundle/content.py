"""The content of ``results.json``."""

from collections.abc import Mapping
from importlib.metadata import version
from typing import Any

from ...agents.hardware.decisions import POLICY_SHARE
from ..episode.metric import SCORING
from ..execution.runner import Run
from ..results.baselines import HUMAN_HUMAN, Baseline
from ..results.summary import group, summarise
from ..suites.suite import Suite
from .table import one_line


def results(run: Run, baselines: Mapping[str, Baseline]) -> dict[str, Any]:
    """Return the content of ``results.json``.

    Everything follows from the episodes, but for what :func:`with_circumstances` names.

    Parameters
    ----------
    run
        The policy's episodes.
    baselines
        Other agents on the same episodes, by name; see :mod:`colift.benchmark.results.baselines`.
    """
    team = baselines.get(HUMAN_HUMAN)
    summary = summarise(run.episodes, run.suite.metrics, team.rmse_mm if team else None)
    summary["real_time"] = real_time(summary["step_ms"]["p99"], run.suite)
    return {
        "colift": version("colift"),
        "suite": run.suite.name,
        "suite_digest": run.suite.digest,
        "scoring": SCORING,
        "complete": run.complete,
        "policy": {"name": one_line(run.policy), "digest": run.policy_digest},
        "isolation": one_line(run.isolation),
        "evaluator_faults": run.faults,
        "summary": summary,
        "groups": group(run.episodes, run.suite.metrics, team.by_stratum() if team else None),
        "baselines": {name: _baseline(value) for name, value in baselines.items()},
    }


def real_time(p99_ms: float | None, suite: Suite) -> bool | None:
    """Return whether a policy keeps up with a real robot; None if it never acted.

    It does if the 99th percentile of its time per step [ms], over all steps of all lifts, is no
    more than the share of the control period that the real-time loop waits for an answer.
    """
    if p99_ms is None:
        return None
    period = min(scenario.control_period for scenario in suite.scenarios)
    return p99_ms <= 1000 * POLICY_SHARE * period


def with_circumstances(
    content: dict[str, Any], claimed: Mapping[str, Any], suite: Suite
) -> dict[str, Any]:
    """Return the content with the circumstances of another: what no simulation can tell.

    They are the version of colift that wrote it, and the policy's times per step. (The policy's
    name and digest, the isolation and the faults come with the run.)
    """
    step_ms = claimed["summary"]["step_ms"]
    timed = {
        "step_ms": {name: step_ms[name] for name in ("p50", "p99")},
        "real_time": real_time(step_ms["p99"], suite),
    }
    return {
        **content,
        "colift": claimed["colift"],
        "summary": {**content["summary"], **timed},
    }


def _baseline(baseline: Baseline) -> dict[str, Any]:
    return {
        "rmse_mm": {
            "mean": baseline.estimate.mean,
            "ci95": list(baseline.estimate.ci95),
        },
        **{name: {"mean": mean} for name, mean in baseline.means.items()},
    }
