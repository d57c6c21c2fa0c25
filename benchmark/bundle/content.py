"""The content of ``results.json``."""

import dataclasses
from collections.abc import Mapping
from dataclasses import dataclass
from importlib.metadata import version
from typing import Any

from colift.agents.real_time import POLICY_SHARE
from colift.benchmark.bundle.table import one_line
from colift.benchmark.channels import Channel
from colift.benchmark.channels.recorded import recorded
from colift.benchmark.episode.metric import SCORING
from colift.benchmark.execution.runner import Run
from colift.benchmark.results.baselines import HUMAN_HUMAN
from colift.benchmark.results.curve import SessionCurve, session_curve
from colift.benchmark.results.goals import GoalScores, goal_scores
from colift.benchmark.results.scores import ScoreTable
from colift.benchmark.results.strata import StratumScore, stratum_scores
from colift.benchmark.results.summary import StepTimes, Summary, plain_estimate, summarise
from colift.benchmark.suites.suite import Suite


@dataclass(frozen=True, kw_only=True)
class Results:
    """The results of a run, as in ``results.json``."""

    colift: str
    """Version of colift."""
    suite: str
    suite_digest: str
    scoring: int
    """Version of the scores."""
    complete: bool
    """Whether every episode of the suite was played."""
    policy: str
    policy_digest: str
    isolation: str
    evaluator_faults: int
    """Number of episodes that were played again because the machine had failed."""
    summary: Summary
    strata: tuple[StratumScore, ...]
    baselines: Mapping[str, ScoreTable]
    """Other agents on the same episodes, without a channel."""
    channel: Channel | None = None
    """The channel between the robot and the policy; None if there is none."""
    session: SessionCurve | None = None
    """The errors lift by lift, if the suite has sessions and all lifts were played."""
    goals: GoalScores | None = None
    """How well people reached the goals of live lifts; None in other lifts, and in bundles that
    do not claim it."""

    def plain(self) -> dict[str, Any]:
        """Return the content of ``results.json``."""
        content: dict[str, Any] = {
            "colift": self.colift,
            "suite": self.suite,
            "suite_digest": self.suite_digest,
            "scoring": self.scoring,
            "complete": self.complete,
            "policy": {"name": self.policy, "digest": self.policy_digest},
            "isolation": self.isolation,
            "evaluator_faults": self.evaluator_faults,
            "summary": self.summary.plain(),
            "groups": [each.plain() for each in self.strata],
            "baselines": {name: _plain_baseline(each) for name, each in self.baselines.items()},
        }
        if self.channel is not None:
            content["channel"] = recorded(self.channel)
        if self.session is not None:
            content["session"] = self.session.plain()
        if self.goals is not None:
            content["goals"] = self.goals.plain()
        return content


def _plain_baseline(baseline: ScoreTable) -> dict[str, Any]:
    return {
        "rmse_mm": plain_estimate(baseline.error),
        **{name: {"mean": mean} for name, mean in baseline.means.items()},
    }


def results(run: Run, baselines: Mapping[str, ScoreTable]) -> Results:
    """Return the results of a run.

    Everything follows from the episodes, except the claims of :func:`with_circumstances`.

    Parameters
    ----------
    run
        The policy's episodes.
    baselines
        Other agents on the same episodes, by name; see :mod:`colift.benchmark.results.baselines`.
    """
    human = baselines.get(HUMAN_HUMAN)
    scores = ScoreTable.of(run)
    summary = summarise(run, scores, human)
    return Results(
        colift=version("colift"),
        suite=run.suite.name,
        suite_digest=run.suite.digest,
        scoring=SCORING,
        complete=run.complete,
        policy=one_line(run.policy),
        policy_digest=run.policy_digest,
        isolation=one_line(run.isolation),
        evaluator_faults=run.faults,
        summary=dataclasses.replace(summary, real_time=real_time(summary.step_ms.p99, run.suite)),
        strata=stratum_scores(scores, human),
        baselines=baselines,
        channel=run.channel,
        session=session_curve(run, scores, human),
        goals=goal_scores(
            run.suite, {episode.trial for episode in run.episodes if episode.failure is not None}
        ),
    )


def real_time(p99_ms: float | None, suite: Suite) -> bool | None:
    """Return whether a policy keeps up with a real robot; None if it never acted.

    It does if the 99th percentile of its time per step [ms], over all steps of all lifts, is at
    most :data:`.POLICY_SHARE` of the control period, the time that the real-time loop waits.
    """
    if p99_ms is None:
        return None
    period = min(scenario.control_period for scenario in suite.scenarios)
    return p99_ms <= 1000 * POLICY_SHARE * period


def with_circumstances(content: Results, claimed: Mapping[str, Any], suite: Suite) -> Results:
    """Return results with those claims of a bundle that no simulation can verify.

    These are the version of colift that wrote the bundle, and the policy's times per step. (The
    policy's name and digest, the isolation and the faults come with the run.) A bundle of live
    lifts that does not claim their goal errors, as older ones do not, gets none.
    """
    step_ms = StepTimes(**{name: claimed["summary"]["step_ms"][name] for name in ("p50", "p99")})
    return dataclasses.replace(
        content,
        colift=claimed["colift"],
        goals=content.goals if "goals" in claimed else None,
        summary=dataclasses.replace(
            content.summary, step_ms=step_ms, real_time=real_time(step_ms.p99, suite)
        ),
    )
