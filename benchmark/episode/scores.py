"""The scores of an episode, and the table of metrics that every view of them loops over."""

import functools
import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Final, Literal

import numpy as np

from ..world.table import TABLE_LENGTH, WEIGHT_SHARE
from . import metrics
from .lift import Lift
from .smoothness import ldlj, sparc
from .trace import Trace

SCORING: Final = 1
"""Version of the scores. It is raised by every change to the code of a metric; then the scores of
older bundles are computed again from their actions."""

REACHED: Final = 0.02
"""The human has reached the intended height if it comes within this of it [m]."""

MOSTLY_CLIPPED: Final = 0.5
"""Share of clipped actions above which they are hardly in metres."""


@dataclass(frozen=True, kw_only=True)
class Scores:
    """The metrics of one episode; NaN where there is none."""

    rmse_mm: float
    abs_error_mm: float
    max_tilt_deg: float
    sparc: float
    ldlj: float
    human_force_n: float
    human_work_j: float
    robot_lag_ms: float
    short_of_goal_mm: float
    """How far below the intended height the human's end stayed [mm]; above 20 mm it has not
    reached it. Negative when it went beyond."""
    clipped: float = math.nan
    """Share of the robot's actions that were cut, as they were larger than a NAO's hands can go in
    a step (:func:`colift.agents.actions.action_limit`)."""

    @property
    def reached(self) -> bool:
        """Whether the human's end reached the intended height, as far as it is known."""
        return not self.short_of_goal_mm > 1000 * REACHED


@dataclass(frozen=True, kw_only=True)
class Metric:
    """How a field of :class:`Scores` is shown, wherever it is shown."""

    name: str
    """The field, and the key in JSON and CSV."""
    symbol: str
    """Heading of a column."""
    label: str
    """The metric in words."""
    unit: str = ""
    """Unit; empty if it has none."""
    digits: int = 2
    """Decimals in a table."""
    better: Literal["less", "more", "near zero"] = "less"
    """Which values are better."""
    missing: Literal["never", "worst", "left out"] = "left out"
    """What an episode without a value means: there is none, it ranks last, or its mean is of the
    other episodes."""
    shown: Literal["board", "run", "file"] = "file"
    """Where it has a column: on boards, in comparisons and a run's table; in a run's table; only in
    files. All are in ``results.json`` and ``episodes.csv``."""
    meaning: str

    @property
    def heading(self) -> str:
        """Symbol and unit."""
        return f"{self.symbol} {self.unit}".rstrip()

    def text(self, value: float | None) -> str:
        """Return a value as tables have it."""
        return "none" if value is None else f"{value:.{self.digits}f}"


METRICS: Final[Mapping[str, Metric]] = {
    metric.name: metric
    for metric in (
        Metric(
            name="rmse_mm",
            symbol="RMSE",
            label="RMSE",
            unit="mm",
            missing="never",
            shown="board",
            meaning="root mean square of Z1 - Z2 over the whole trial, rest included. The paper's "
            "measure, by which policies are ranked",
        ),
        Metric(
            name="abs_error_mm",
            symbol="error",
            label="Absolute error",
            unit="mm",
            digits=0,
            missing="never",
            meaning="the paper's eq. 10: sum of the absolute difference over all frames",
        ),
        Metric(
            name="max_tilt_deg",
            symbol="tilt",
            label="Tilt",
            unit="°",
            digits=1,
            shown="run",
            meaning="largest incline of the table",
        ),
        Metric(
            name="sparc",
            symbol="SPARC",
            label="Smoothness",
            better="more",
            missing="worst",
            shown="board",
            meaning="smoothness of the robot's end, mean over the human's strokes: spectral arc "
            "length (20 Hz, threshold 0.05); nearer to zero is smoother",
        ),
        Metric(
            name="ldlj",
            symbol="LDLJ",
            label="Jerk",
            digits=1,
            better="more",
            missing="worst",
            shown="run",
            meaning="the same by log dimensionless jerk",
        ),
        Metric(
            name="human_force_n",
            symbol="force",
            label="Human force",
            unit="N",
            shown="board",
            meaning="root mean square of the vertical force at the human's hands, beyond their "
            "half of the table's weight",
        ),
        Metric(
            name="human_work_j",
            symbol="work",
            label="Human work",
            unit="J",
            meaning="integral of the magnitude of that force times the hands' velocity",
        ),
        Metric(
            name="robot_lag_ms",
            symbol="lag",
            label="Lag",
            unit="ms",
            digits=0,
            better="near zero",
            shown="run",
            meaning="delay at which the robot's velocity matches the human's best",
        ),
        Metric(
            name="short_of_goal_mm",
            symbol="short",
            label="Short of the goal",
            unit="mm",
            digits=1,
            missing="never",
            meaning="how far below the intended height the human's end stayed; above 20 mm the "
            "goal was not reached",
        ),
        Metric(
            name="clipped",
            symbol="clipped",
            label="Clipped actions",
            meaning="share of the robot's actions that were larger than its hands can go in a step "
            "(0.04 m in 100 ms) and cut to that: nearly 1 where millimetres were meant for metres",
        ),
    )
}
"""Each field of :class:`Scores`, in its order. A new metric is a field, its value in :func:`score`
and an entry here: tables, CSV, JSON, API and pages loop over them."""


BOARD: Final = tuple(
    each for each in METRICS.values() if each.shown == "board" and each.name != "rmse_mm"
)
"""The metrics beside RMSE that boards and comparisons show."""


def score(lift: Lift, trace: Trace, *, failed: bool) -> Scores:
    """Return the metrics of a trace of the lift's current episode.

    A failed episode keeps the frames it has for force and work; it has no smoothness and no lag.
    """
    human, robot, horizon = trace.human_end, trace.robot_end, lift.horizon
    felt = trace.human_force - WEIGHT_SHARE
    smoothness = functools.partial(metrics.stroke_smoothness, robot, human, lift.plan.strokes)
    empty = len(human) == 0
    return Scores(
        rmse_mm=metrics.rmse_mm(human, robot, horizon=horizon),
        abs_error_mm=metrics.abs_error_mm(human, robot, horizon=horizon),
        max_tilt_deg=math.nan if empty else metrics.max_tilt_deg(human, robot, length=TABLE_LENGTH),
        sparc=math.nan if failed else smoothness(metric=sparc),
        ldlj=math.nan if failed else smoothness(metric=ldlj),
        human_force_n=math.nan if empty else metrics.human_force_n(felt),
        human_work_j=math.nan if empty else metrics.human_work_j(felt, trace.human_velocity),
        robot_lag_ms=math.nan if failed else metrics.robot_lag_ms(human, robot),
        short_of_goal_mm=1000 * (lift.plan.goal - float(human.max(initial=0.0))),
        clipped=_clipped(lift, trace),
    )


def _clipped(lift: Lift, trace: Trace) -> float:
    """Return the share of the actions that were cut; a second human's are not."""
    if lift.scenario.partner != "nao" or len(trace.action) == 0:
        return math.nan
    return int((np.abs(trace.action) > lift.step_limit).sum()) / len(trace.action)
