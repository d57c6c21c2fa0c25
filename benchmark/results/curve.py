"""The curve of a session: the errors of its lifts, in order, and the trust of its people."""

import math
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from typing import Any, Final, Self

import msgspec
import numpy as np
from colift.agents.humans.serial import Serial
from colift.benchmark.execution.runner import Run
from colift.benchmark.execution.sessions import after
from colift.benchmark.rendering.axis import Axis, make_axis
from colift.benchmark.results.scores import ScoreTable
from colift.benchmark.results.summary import plain_estimate
from colift.benchmark.statistics import Estimate, Units, mean_of
from colift.benchmark.suites.suite import Suite
from numpy.typing import NDArray

LEAST: Final = 1e-3
"""Error below which a lift counts as perfect [mm]: no sensor sees it."""


@dataclass(frozen=True, kw_only=True)
class SessionCurve:
    """What happens from the first lift of a session to the last, over the people."""

    counted: int
    """Lifts at the end that count."""
    rmse_mm: tuple[Estimate, ...]
    """Mean RMSE of each lift [mm], with its interval for other people."""
    human_human_rmse_mm: tuple[Estimate, ...] | None
    """That of two people on the same lifts; None if they are not known."""
    change_mm: Estimate | None
    """RMSE of the lift in which a person changes a habit, less that of the lift before [mm]; None
    if nobody does."""
    trust: tuple[Estimate, ...]
    """Mean trust of the people after each lift, from 0 to 1; empty if it is not known."""

    def plain(self) -> dict[str, Any]:
        """Return the curve, ready for JSON."""
        people = self.human_human_rmse_mm
        return {
            "counted": self.counted,
            "rmse_mm": _plain(self.rmse_mm),
            "human_human_rmse_mm": None if people is None else _plain(people),
            "change_mm": None if self.change_mm is None else plain_estimate(self.change_mm),
            "trust": _plain(self.trust),
        }

    @classmethod
    def read(cls, content: Mapping[str, Any]) -> Self:
        """Return the curve that :meth:`plain` has written."""
        return msgspec.convert(content, cls)

    @property
    def learned(self) -> str:
        """What the policy and its people have learned, in one line."""
        change = self.change_mm
        return "; ".join(
            (
                *(() if len(self.rmse_mm) < 2 else [self._from_lift_to_lift]),
                f"{self.whole:.1f} mm over all",
                *(() if change is None else [f"{change.mean:+.1f} mm when a habit changes"]),
                *(f"people's trust at the end {last.mean:.2f} of 1" for last in self.trust[-1:]),
            )
        )

    @property
    def whole(self) -> float:
        """Mean RMSE of all lifts [mm]: the area under the curve."""
        return float(np.mean([each.mean for each in self.rmse_mm]))

    @property
    def _from_lift_to_lift(self) -> str:
        return f"{100 * math.expm1(self.rate):+.0f} % from lift to lift"

    @property
    def rate(self) -> float:
        """Change of the logarithm of the mean RMSE from lift to lift, by least squares.

        There must be two lifts or more.
        """
        errors = [math.log(max(each.mean, LEAST)) for each in self.rmse_mm]
        return float(np.polyfit(range(len(errors)), errors, 1)[0])


def _plain(curve: Iterable[Estimate]) -> list[dict[str, Any]]:
    return [plain_estimate(each) for each in curve]


def session_curve(
    run: Run, scores: ScoreTable, human_human: ScoreTable | None
) -> SessionCurve | None:
    """Return the curve of a run and its scores; None without sessions, or if lifts are missing."""
    suite = run.suite
    if not suite.session or not run.complete:
        return None
    return SessionCurve(
        counted=sum(map(suite.counts, range(suite.session))),
        rmse_mm=lift_errors(suite, scores),
        human_human_rmse_mm=None if human_human is None else lift_errors(suite, human_human),
        change_mm=_change(suite, _by_session(suite, scores)),
        trust=_trust(run),
    )


def lift_errors(suite: Suite, scores: ScoreTable) -> tuple[Estimate, ...]:
    """Return the mean RMSE of each lift of a session over the people [mm]."""
    return _over_people(suite, _by_session(suite, scores))


def _by_session(suite: Suite, scores: ScoreTable) -> NDArray[np.float64]:
    """Return the errors, sessions x lifts [mm]."""
    return np.reshape(scores.lifts_mm, (-1, suite.session))


def _over_people(suite: Suite, values: NDArray[np.float64]) -> tuple[Estimate, ...]:
    """Return the mean of each column of sessions x lifts."""
    units = Units.people((each.behaviour, each.person) for each in suite.scenarios)
    return tuple(mean_of(column, units) for column in values.T)


def _change(suite: Suite, errors: NDArray[np.float64]) -> Estimate | None:
    """Return by how much the error rises in the lift of a change; None if there is none."""
    rises, people = [], []
    for scenario, row in zip(suite.scenarios, errors, strict=True):
        human = scenario.human
        place = human.change(scenario.subject) if isinstance(human, Serial) else None
        if place is not None and 0 < place < suite.session:
            rises.append(row[place] - row[place - 1])
            people.append((scenario.behaviour, scenario.person))
    return mean_of(rises, Units.people(people)) if rises else None


def _trust(run: Run) -> tuple[Estimate, ...]:
    """Return the mean trust of the people after each lift; empty if it is not known."""
    lifts, found = iter(run.episodes), []
    for scenario in run.suite.scenarios:
        for _ in range(run.suite.session):
            scenario = after(scenario, next(lifts).trace)
            human = scenario.human
            found.append(human.trust if isinstance(human, Serial) else None)
    if None in found:
        return ()
    return _over_people(run.suite, np.reshape(np.array(found), (-1, run.suite.session)))


def session_axis(curve: SessionCurve | None) -> Axis | None:
    """Return the scale of a table of a curve; None without one."""
    if curve is None:
        return None
    return make_axis(curve.rmse_mm, [each.mean for each in curve.human_human_rmse_mm or ()])
