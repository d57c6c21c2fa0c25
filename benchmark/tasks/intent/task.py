"""The task to bring the table to the pose that the human intends, and its suite."""

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import ClassVar

import numpy as np
from colift.agents.agent import Agent, Observation
from colift.agents.humans import SUBJECTS
from colift.agents.humans.intent import Companion
from colift.benchmark.episode import metrics
from colift.benchmark.episode.metric import Metrics, Scores
from colift.benchmark.episode.scenario import Scenario
from colift.benchmark.episode.task import Playing
from colift.benchmark.episode.trace import Trace
from colift.benchmark.suites.catalogue import make_scenario
from colift.benchmark.suites.suite import Suite
from colift.benchmark.tasks.haptic import Haptic
from colift.benchmark.tasks.intent.lift import IntentLift
from colift.benchmark.tasks.intent.scores import opposing_work_j, peak_mm, pose_rmse_mm, settling_ms
from colift.benchmark.tasks.intent.table import INTENT_METRICS
from colift.benchmark.world.table import TABLE_LENGTH, WEIGHT_SHARE
from numpy.typing import NDArray

BEHAVIOURS = ("together", "pivot", "counter", "switching")


@dataclass(frozen=True, kw_only=True)
class Intent(Haptic):
    """Bring the table to the pose that the human intends: level, pivoted, or turned.

    The robot has :class:`.HapticObservation`: it sees the motion of the human's end, and feels the
    torque of the human's wrists. The human has :class:`.HumanObservation`, and slows down if the
    far end does not follow.
    """

    name: ClassVar[str] = "intent"
    metrics: ClassVar[Metrics] = INTENT_METRICS
    second_human: ClassVar[type[Agent]] = Companion

    def lift(self, scenario: Scenario) -> IntentLift:
        """Return a lift whose human intends poses."""
        return IntentLift(scenario)

    def human_observation(self, lift: Playing) -> Observation:
        """Return the human's senses and intended heights of the human's end in the coming step."""
        assert isinstance(lift, IntentLift)
        return lift.human_view(lift.intended())

    def rewards(self, lift: Playing) -> tuple[float, float]:
        """Return minus the distances of both ends, and of the far end alone, from the pose [m]."""
        near, far = (abs(float(each[-1])) for each in _missed(lift))
        return -near - far, -far

    def series(self, lift: Playing) -> Mapping[str, NDArray[np.float64]]:
        """Return the intended height of the far end, and the torque of the robot's hands."""
        assert isinstance(lift, IntentLift)
        return {
            "far_target": lift.far_target[: lift.frame],
            "robot_torque": np.array(lift.world.robot_torque[-lift.frame :][: lift.frame]),
        }

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
            "rmse_mm": pose_rmse_mm((near, far), lift.horizon),
            "settling_ms": nan if failed else settling_ms(far, strokes),
            "peak_mm": nan if failed else peak_mm(far, strokes),
            "near_rmse_mm": nan if empty else pose_rmse_mm((near,), len(near)),
            "max_tilt_deg": tilt,
            "human_force_n": nan if empty else metrics.human_force_n(felt),
            "opposing_work_j": opposing_work_j(felt, trace.human_velocity),
            "clipped": lift.clipped(trace.action),
        }


def _missed(lift: Playing) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Return the heights of the ends above their intended ones in the last frame [m]."""
    assert isinstance(lift, IntentLift)
    last = lift.frame - 1
    return (
        np.array([lift.world.human_end[-1] - lift.target[last]]),
        np.array([lift.world.robot_end[-1] - lift.far_target[last]]),
    )


def intent_suite() -> Suite:
    """5 subjects x 4 intents x 5 lifts: the poses that a human intends."""
    scenarios = tuple(
        make_scenario(behaviour, subject, task=Intent.name)
        for behaviour in BEHAVIOURS
        for subject in SUBJECTS
    )
    return Suite(name="intent-v1", scenarios=scenarios, seeds=tuple(range(5)))
