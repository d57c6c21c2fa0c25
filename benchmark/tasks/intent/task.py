"""The task to bring the table to the pose that the human intends, and its suite."""

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, ClassVar, Final, NamedTuple

import numpy as np
from colift.agents.agent import Agent
from colift.agents.humans import Plan
from colift.agents.humans.person import Person
from colift.agents.rules import SCALARS, ArrayFunctions, Drawn, N, View
from colift.benchmark.episode import metrics
from colift.benchmark.episode.lift import lasting
from colift.benchmark.episode.metric import Metrics, Scores
from colift.benchmark.episode.task import Playing
from colift.benchmark.episode.trace import Trace
from colift.benchmark.suites.people import people_suite
from colift.benchmark.suites.ranges import INTENT_PEOPLE
from colift.benchmark.suites.suite import Suite
from colift.benchmark.tasks.intent.companion import Companion
from colift.benchmark.tasks.intent.person import Leads
from colift.benchmark.tasks.intent.poses import PosePlan
from colift.benchmark.tasks.intent.scores import opposing_work_j, peak_mm, pose_rmse_mm, settling_ms
from colift.benchmark.tasks.intent.table import INTENT_METRICS
from colift.benchmark.tasks.touch import Touch, torque_of
from colift.benchmark.world.table import TABLE_LENGTH, WEIGHT_SHARE
from numpy.typing import NDArray

DOWN: Final = 0.05
"""Height of an end [m] up to which the table counts as put down."""


class Pose(NamedTuple):
    """The task's series: planned heights at the end of each frame [m]."""

    near: Any
    """Of the human's end."""
    far: Any
    """Of the far end."""


class Lowering(NamedTuple):
    """The task's numbers: the last movement of the plan, which puts the table down."""

    start: Any
    """Its first frame."""
    stop: Any
    """The frame after its last; 0, as the first, without a movement."""


@dataclass(frozen=True, kw_only=True)
class Intent(Touch):
    """Bring the table to the pose that the human intends: level, pivoted, or turned.

    The robot has :class:`.HapticObservation`: it sees the motion of the human's end, and feels the
    torque of the human's wrists. The human has :class:`.HumanObservation`, and slows down if the
    far end does not follow: a plan may not be done when the lift is over (:meth:`unfinished`).
    """

    name: ClassVar[str] = "intent"
    metrics: ClassVar[Metrics] = INTENT_METRICS
    person: ClassVar[Person] = Leads()
    second_human: ClassVar[type[Agent]] = Companion
    behaviours: ClassVar[tuple[str, ...]] = ("together", "pivot", "counter", "switching")

    def setting(self, plan: Plan, frames: int, seed: Callable[[str], int]) -> tuple[Pose, Lowering]:
        """Return the planned heights of both ends, and the last movement."""
        far = plan.far if isinstance(plan, PosePlan) else plan.target
        start, stop = plan.strokes[-1] if plan.strokes else (0, 0)
        pose = Pose(lasting(plan.target, frames), lasting(far, frames))
        return pose, Lowering(float(start), float(stop))

    def missed(self, f: ArrayFunctions[N], due: Any, ends: Any) -> Sequence[N]:
        """Return the square distance of the ends from the pose, averaged over both."""
        return (((ends.near - due.near) ** 2 + (ends.far - due.far) ** 2) / 2,)

    def unfinished(self, f: ArrayFunctions[N], drawn: Drawn[N], view: View[N]) -> N:
        """Return the frames of the plan, to the end of its last movement, that are not done.

        Those are the frames that the person has not come to; and all frames of the last movement,
        which puts the table down, while an end is higher than :data:`DOWN`.
        """
        lowering = drawn.facts
        late = f.clip(lowering.stop - view.seen("time", 0), 0.0, math.inf)
        ends = f.abs(view.seen("human_end", 0)), f.abs(view.seen("robot_end", 0))
        up = f.logical_or(ends[0] > DOWN, ends[1] > DOWN)
        last = lowering.stop - lowering.start
        return f.where(f.logical_and(up, late < last), last, late)

    def rewards(self, lift: Playing) -> tuple[float, float]:
        """Return minus the distances of both ends, and of the far end alone, from the pose [m]."""
        world, last = lift.world, lift.frame - 1
        near = abs(float(world.human_end[-1] - lift.due.near[last]))
        far = abs(float(world.robot_end[-1] - lift.due.far[last]))
        return -near - far, -far

    def series(self, lift: Playing) -> Mapping[str, NDArray[np.float64]]:
        """Return the intended height of the far end, and the torque of the robot's hands."""
        return {"far_target": lift.due.far[: lift.frame], "robot_torque": torque_of(lift)}

    def score(self, lift: Playing, trace: Trace, *, failed: bool) -> Scores:
        """Return the scores of :data:`.INTENT_METRICS`."""
        near = trace.human_end - trace.target
        far = trace.robot_end - trace.added["far_target"]
        felt = trace.human_force - WEIGHT_SHARE
        nan, empty = math.nan, len(near) == 0
        strokes = lift.plan.strokes
        tilt = (
            nan if empty else metrics.max_tilt_deg(trace.human_end, trace.robot_end, TABLE_LENGTH)
        )
        return {
            "rmse_mm": self.rmse_mm(lift, trace),
            "settling_ms": nan if failed else settling_ms(far, strokes),
            "finished": self._finished(lift),
            "peak_mm": nan if failed else peak_mm(far, strokes),
            "near_rmse_mm": nan if empty else pose_rmse_mm((near,), len(near)),
            "max_tilt_deg": tilt,
            "human_force_n": nan if empty else metrics.human_force_n(felt),
            "opposing_work_j": opposing_work_j(felt, trace.human_velocity),
            "clipped": lift.clipped(trace.action),
        }

    def _finished(self, lift: Playing) -> float:
        """Return the share of the plan that is done; NaN without a movement."""
        stop: float = lift.facts.stop
        return 1.0 - self.unfinished(SCALARS, lift.drawn, lift) / stop if stop else math.nan


def intent_suite() -> Suite:
    """25 people x 4 intents: the poses that a human intends."""
    return people_suite("intent-v1", Intent.name, Intent.behaviours, INTENT_PEOPLE)
