"""The curve of a session: the mean error of each of its lifts, over the people."""

from dataclasses import dataclass
from typing import Any

import numpy as np
from colift.benchmark.results.scores import ScoreTable
from colift.benchmark.results.summary import plain_estimate
from colift.benchmark.statistics import Estimate, Units, mean_of
from colift.benchmark.suites.suite import Suite


@dataclass(frozen=True, kw_only=True)
class SessionCurve:
    """The errors of a policy in the lifts of a session, first to last."""

    counted: int
    """Lifts at the end that count."""
    rmse_mm: tuple[Estimate, ...]
    """Mean RMSE over the people [mm], with its interval for other people."""
    human_human_rmse_mm: tuple[Estimate, ...] | None
    """That of two people on the same lifts; None if they are not known."""

    def plain(self) -> dict[str, Any]:
        """Return the curve, ready for JSON."""
        people = self.human_human_rmse_mm
        return {
            "counted": self.counted,
            "rmse_mm": [plain_estimate(each) for each in self.rmse_mm],
            "human_human_rmse_mm": None
            if people is None
            else [plain_estimate(each) for each in people],
        }

    @property
    def whole(self) -> float:
        """Mean RMSE of all lifts [mm]: the area under the curve."""
        return float(np.mean([each.mean for each in self.rmse_mm]))


def session_curve(
    suite: Suite, scores: ScoreTable, human_human: ScoreTable | None
) -> SessionCurve | None:
    """Return the curve of scores on a suite; None without sessions, or if lifts are missing."""
    if not suite.session or len(scores.lifts_mm) != suite.size:
        return None
    return SessionCurve(
        counted=sum(map(suite.counts, range(suite.session))),
        rmse_mm=_estimates(suite, scores),
        human_human_rmse_mm=None if human_human is None else _estimates(suite, human_human),
    )


def _estimates(suite: Suite, scores: ScoreTable) -> tuple[Estimate, ...]:
    units = Units.people((each.behaviour, each.person) for each in suite.scenarios)
    errors = np.reshape(scores.lifts_mm, (-1, suite.session))
    return tuple(mean_of(column, units) for column in errors.T)
