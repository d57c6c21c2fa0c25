"""The task of the paper: to keep the table level while the human lifts and lowers it."""

import functools
import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import ClassVar, Final

import numpy as np
from colift.agents.agent import FRAME, HumanObservation, Observation, RobotObservation
from colift.benchmark.episode import metrics
from colift.benchmark.episode.level_metrics import LEVEL_METRICS
from colift.benchmark.episode.metric import Metrics, Scores
from colift.benchmark.episode.smoothness import ldlj, sparc
from colift.benchmark.episode.task import Bounds, Playing
from colift.benchmark.episode.trace import Trace
from colift.benchmark.world import PHYSICS, BodyParameters, BulletWorld, FarEnd, Physics
from colift.benchmark.world.table import TABLE_LENGTH, WEIGHT_SHARE
from numpy.typing import NDArray

DROP_TILT: Final = math.radians(40)
"""A table inclined by more than this [rad] slides out of the hands."""

GRIP_FORCE: Final = 20.0
"""Mean force over a control period [N] above which the partner's two hands lose the table."""

GRIP_GAP: Final = 0.03
"""Distance between the NAO's hands and the table's end [m] at which the hold is lost."""

HEIGHT_BOUND: Final = 2.0
"""Bound of every height in an observation [m]; a lift stays far inside it."""

VELOCITY_BOUND: Final = 50.0
"""Bound of every velocity in an observation [m/s]."""

FORCE_BOUND: Final = 1e4
"""Bound of every force in an observation [N]."""

LONGEST_EPISODE: Final = 120.0
"""Bound of the time in an observation [s]; a step of at most 0.5 s may end beyond it."""


@dataclass(frozen=True, kw_only=True)
class Level:
    """Keep the table level: the error is the height difference of its two ends.

    The robot has :class:`.RobotObservation` and not the human's intention. The human has
    :class:`.HumanObservation` with the intended heights. A second human in the robot's place has
    the same senses and intends to be at the seen height of the other end.
    """

    name: ClassVar[str] = "level"
    metrics: ClassVar[Metrics] = LEVEL_METRICS

    def world(
        self, human: BodyParameters, far_end: FarEnd, *, physics: Physics = PHYSICS
    ) -> BulletWorld:
        """Return the world of the table alone."""
        return BulletWorld(human, far_end, physics=physics)

    def robot_observation(self, lift: Playing) -> Observation:
        """Return the robot's senses."""
        return lift.robot_view()

    def human_observation(self, lift: Playing) -> Observation:
        """Return the human's senses and the intended heights in the coming step."""
        frame = lift.frame
        return lift.human_view(lift.target[frame : frame + lift.frames_per_step])

    def partner_observation(self, lift: Playing) -> Observation:
        """Return a second human's senses; its target is the height of the end that it sees."""
        return lift.partner_view(np.full(lift.frames_per_step, lift.seen_by_partner()))

    def robot_bounds(self) -> Bounds:
        """Return the bounds of :class:`.RobotObservation`."""
        high = np.full(len(RobotObservation), HEIGHT_BOUND)
        low = -high
        high[RobotObservation.TIME] = LONGEST_EPISODE + 0.5
        low[RobotObservation.TIME] = 0.0
        return low, high

    def human_bounds(self, frames: int) -> Bounds:
        """Return the bounds of :class:`.HumanObservation`."""
        high = np.full(HumanObservation.size(frames), HEIGHT_BOUND)
        high[HumanObservation.OWN_VELOCITY] = VELOCITY_BOUND
        high[HumanObservation.HAND_FORCE] = FORCE_BOUND
        low = -high
        high[HumanObservation.TIME] = LONGEST_EPISODE + FRAME
        low[HumanObservation.TIME] = 0.0
        return low, high

    def rewards(self, lift: Playing) -> tuple[float, float]:
        """Return ``-|Z1 - target| - |Z1 - Z2|`` and ``-|Z1 - Z2|`` [m], the integrand of eq. 10."""
        human = lift.world.human_end[-1]
        level = abs(human - lift.world.robot_end[-1])
        miss = abs(human - lift.target[lift.frame - 1])
        return -float(miss) - level, -level

    def failure(self, lift: Playing) -> str | None:
        """Return how the table was dropped in the step just made, or None."""
        world, size = lift.world, lift.frames_per_step
        if abs(world.human_end[-1] - world.robot_end[-1]) > TABLE_LENGTH * math.sin(DROP_TILT):
            return f"the table is inclined by more than {math.degrees(DROP_TILT):.0f} deg"
        if abs(math.fsum(world.robot_force[-size:])) > GRIP_FORCE * size:
            return f"more than {GRIP_FORCE:.0f} N pull at the partner's hands"
        if abs(world.hand_height - world.robot_end[-1]) > GRIP_GAP:
            return "the table's end is out of the partner's reach"
        return None

    def series(self, lift: Playing) -> Mapping[str, NDArray[np.float64]]:
        """Return no series: everything is in the fields of :class:`.Trace`."""
        return {}

    def score(self, lift: Playing, trace: Trace, *, failed: bool) -> Scores:
        """Return the scores of :data:`.LEVEL_METRICS`.

        For a failed episode, force and work are computed from the frames that it has; it has no
        smoothness and no lag.
        """
        human, robot, horizon = trace.human_end, trace.robot_end, lift.horizon
        felt = trace.human_force - WEIGHT_SHARE
        smoothness = functools.partial(metrics.stroke_smoothness, robot, human, lift.plan.strokes)
        nan, empty = math.nan, len(human) == 0
        return {
            "rmse_mm": metrics.rmse_mm(human, robot, horizon=horizon),
            "abs_error_mm": metrics.abs_error_mm(human, robot, horizon=horizon),
            "max_tilt_deg": nan if empty else metrics.max_tilt_deg(human, robot, TABLE_LENGTH),
            "sparc": nan if failed else smoothness(metric=sparc),
            "ldlj": nan if failed else smoothness(metric=ldlj),
            "human_force_n": nan if empty else metrics.human_force_n(felt),
            "human_work_j": nan if empty else metrics.human_work_j(felt, trace.human_velocity),
            "robot_lag_ms": nan if failed else metrics.robot_lag_ms(human, robot),
            "short_of_goal_mm": 1000 * (lift.plan.goal - float(human.max(initial=0.0))),
            "clipped": lift.clipped(trace.action),
        }


LEVEL: Final = Level()
