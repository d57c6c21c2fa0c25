"""The goal errors of the live lifts of a suite, which are the same for every policy."""

import math
from collections.abc import Collection, Mapping
from dataclasses import asdict, dataclass
from typing import Any

from colift.agents.humans import (
    LIVE_SUBJECT,
    GoalError,
    LoggedHand,
    Played,
    goal_error_mm,
    goal_errors,
)
from colift.benchmark.statistics import MeanWithMissing, mean_with_missing
from colift.benchmark.suites.suite import Suite


@dataclass(frozen=True, kw_only=True)
class GoalScores:
    """The goal errors of live lifts."""

    lifts: Mapping[str, float | None]
    """Goal error of each lift by its trial [mm]; None if the lift failed."""
    missed: int
    """Number of lifts in which a goal was not reached."""

    @property
    def mean(self) -> MeanWithMissing:
        """The mean over the lifts that did not fail [mm], and the number of the others."""
        values = self.lifts.values()
        return mean_with_missing([math.nan if each is None else each for each in values])

    def __str__(self) -> str:
        mean = self.mean.mean
        off = "" if mean is None else f"the hands were {mean:.1f} mm from their goals on average"
        missed = f"a goal was missed in {self.missed} of them" if self.missed else ""
        said = "; ".join(filter(None, (off, missed)))
        return f"In these live lifts, {said}, with every policy." if said else ""

    def plain(self) -> dict[str, Any]:
        """Return the goal errors, ready for JSON."""
        return {"error_mm": asdict(self.mean), "missed": self.missed, "lifts": dict(self.lifts)}


def lift_goal_errors(played: Played) -> tuple[GoalError, ...]:
    """Return the error of each goal of a live lift, from the samples of the person's hand."""
    hand = LoggedHand(played.log)
    return goal_errors(played.cue, [hand.next() for _ in played.plan(LIVE_SUBJECT, 0).target])


def goal_scores(suite: Suite, failed: Collection[str] = ()) -> GoalScores | None:
    """Return the goal errors of a suite of live lifts; None if it has others.

    Parameters
    ----------
    suite
        The suite.
    failed
        Trials of the lifts that failed, whose goals were not all shown.
    """
    played = {each.trial: each.human for each in suite.scenarios if isinstance(each.human, Played)}
    if len(played) != len(suite.scenarios):
        return None
    errors = {
        trial: None if trial in failed else lift_goal_errors(human)
        for trial, human in played.items()
    }
    return GoalScores(
        lifts={
            trial: None if lift is None else goal_error_mm(lift) for trial, lift in errors.items()
        },
        missed=sum(any(each.missed for each in lift or ()) for lift in errors.values()),
    )
