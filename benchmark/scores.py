"""The scores of an episode."""

import functools
import math
from dataclasses import dataclass
from typing import Final

from . import metrics
from .lift import Lift
from .smoothness import ldlj, sparc
from .trace import Trace
from .world.table import TABLE_LENGTH, WEIGHT_SHARE

SCORING: Final = 1
"""Version of the scores. It is raised by every change to the code of a metric; then the scores of
older bundles are computed again from their actions."""

REACHED: Final = 0.02
"""The human has reached the intended height if it comes within this of it [m]."""


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

    @property
    def reached(self) -> bool:
        """Whether the human's end reached the intended height, as far as it is known."""
        return not self.short_of_goal_mm > 1000 * REACHED


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
    )
