"""The task of the paper: to keep the table level while the human lifts and lowers it."""

import functools
import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, ClassVar, Final

import numpy as np
from colift.agents.agent import FRAME, HumanObservation, Observation
from colift.agents.humans import Plan
from colift.agents.humans.following import FOLLOWS_PLAN
from colift.agents.humans.person import Person
from colift.agents.rules import SCALARS, ArrayFunctions, Drawn, N, View
from colift.agents.senses import (
    FORCE_BOUND,
    HEIGHT_BOUND,
    LONGEST_EPISODE,
    SIGHT,
    TOUCH,
    Sense,
)
from colift.benchmark.episode import metrics
from colift.benchmark.episode.drops import (
    DROP_TILT,
    GRIP_FORCE,
    out_of_reach,
    pulled_off,
    slides_off,
)
from colift.benchmark.episode.metric import Metrics, Scores
from colift.benchmark.episode.smoothness import ldlj, sparc
from colift.benchmark.episode.task import Bounds, Playing
from colift.benchmark.episode.trace import Trace
from colift.benchmark.tasks.level.table import LEVEL_METRICS
from colift.benchmark.world.human_body import BodyParameters
from colift.benchmark.world.interface import FarEnd, World
from colift.benchmark.world.physics import PHYSICS, Physics
from colift.benchmark.world.table import TABLE, TABLE_LENGTH, Table
from numpy.typing import NDArray

BEHAVIOURS: Final = ("smooth", "pause", "jerky", "changing_goal")
"""The behaviours of people, by name: those of the standard suites."""

VELOCITY_BOUND: Final = 50.0
"""Bound of every velocity in an observation [m/s]."""


@dataclass(frozen=True, kw_only=True)
class Level:
    """Keep the table level: the error is the height difference of its two ends.

    The robot has :class:`.RobotObservation` and not the human's intention. The human has
    :class:`.HumanObservation` with the intended heights. A second human in the robot's place has
    the same senses and intends to be at the seen height of the other end.
    """

    name: ClassVar[str] = "level"
    metrics: ClassVar[Metrics] = LEVEL_METRICS
    person: ClassVar[Person] = FOLLOWS_PLAN
    touch: ClassVar[bool] = False
    physics: ClassVar[Physics] = PHYSICS
    senses: ClassVar[tuple[Sense, ...]] = ()
    behaviours: ClassVar[tuple[str, ...]] = BEHAVIOURS

    def setting(self, plan: Plan, frames: int, seed: Callable[[str], int]) -> tuple[Any, Any]:
        """Return nothing: the plan is all there is."""
        return (), ()

    def observe(self, f: ArrayFunctions[N], drawn: Drawn[N], view: View[N]) -> Sequence[N]:
        """Return nothing besides sight and touch."""
        return ()

    def world(
        self,
        human: BodyParameters,
        far_end: FarEnd,
        table: Table = TABLE,
        *,
        physics: Physics | None = None,
    ) -> World:
        """Return the world of the table alone."""
        # The engine is imported where it is used: rules and twin do without.
        from colift.benchmark.world.bullet_world import BulletWorld

        return BulletWorld(human, far_end, table, physics=physics or self.physics)

    def robot_observation(self, lift: Playing) -> Observation:
        """Return the robot's senses."""
        return lift.robot_view()

    def human_observation(self, lift: Playing) -> Observation:
        """Return the human's senses and the intended heights in the coming step."""
        return lift.human_view(np.array(lift.intention.target))

    def second_person_observation(self, lift: Playing) -> Observation:
        """Return a second human's senses; its target is the height of the end that it sees."""
        return lift.second_person_view(np.full(lift.frames_per_step, lift.seen_by_second_person()))

    def robot_bounds(self) -> Bounds:
        """Return the bounds of the robot's senses."""
        every = (*SIGHT, *(TOUCH if self.touch else ()), *self.senses)
        return np.array([each.low for each in every]), np.array([each.high for each in every])

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
        if slides_off(SCALARS, world.human_end[-1] - world.robot_end[-1]):
            return f"the table is inclined by more than {math.degrees(DROP_TILT):.0f} deg"
        if pulled_off(SCALARS, math.fsum(world.robot_force[-size:]), size):
            return f"more than {GRIP_FORCE:.0f} N pull at the partner's hands"
        if out_of_reach(SCALARS, world.hand_height - world.robot_end[-1]):
            return "the table's end is out of the partner's reach"
        return None

    def series(self, lift: Playing) -> Mapping[str, NDArray[np.float64]]:
        """Return no series: everything is in the fields of :class:`.Trace`."""
        return {}

    def score(self, lift: Playing, trace: Trace, *, failed: bool) -> Scores:
        """Return the scores of :data:`.LEVEL_METRICS`.

        For a failed episode, force and work are computed from the frames that it has; it has no
        smoothness and no lag. The part of a plan that is :func:`unfinished` counts like frames that
        a failure cut off.
        """
        human, robot, horizon = trace.human_end, trace.robot_end, lift.horizon
        felt = trace.human_force - lift.table.weight_share
        over = horizon + (0 if failed else unfinished(lift))
        smoothness = functools.partial(metrics.stroke_smoothness, robot, human, lift.plan.strokes)
        nan, empty = math.nan, len(human) == 0
        return {
            "rmse_mm": metrics.rmse_mm(human, robot, horizon=over),
            "rmse_about_mean_mm": metrics.rmse_about_mean_mm(human, robot, horizon=over),
            "abs_error_mm": metrics.abs_error_mm(human, robot, horizon=over),
            "max_tilt_deg": nan if empty else metrics.max_tilt_deg(human, robot, TABLE_LENGTH),
            "sparc": nan if failed else smoothness(metric=sparc),
            "ldlj": nan if failed else smoothness(metric=ldlj),
            "rest_speed_mm_s": nan if empty else metrics.rest_speed_mm_s(robot, lift.plan.strokes),
            "human_force_n": nan if empty else metrics.human_force_n(felt),
            "human_work_j": nan if empty else metrics.human_work_j(felt, trace.human_velocity),
            "robot_lag_ms": nan if failed else metrics.robot_lag_ms(human, robot),
            "short_of_goal_mm": 1000 * (lift.plan.goal - float(human.max(initial=0.0))),
            "clipped": lift.clipped(trace.action),
        }


def unfinished(lift: Playing) -> int:
    """Return the frames of a plan's movements that a person has not come to.

    They are 0 for a person whose intention has no ``time``, who goes along with the clock.
    """
    strokes = lift.plan.strokes
    if "time" not in lift.intention._fields or not strokes:
        return 0
    return max(math.ceil(strokes[-1][1] - lift.seen("time", 0)), 0)


LEVEL: Final = Level()
