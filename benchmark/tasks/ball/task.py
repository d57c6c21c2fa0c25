"""The task to steer a ball on the table to a target place, and its suite."""

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import ClassVar, Final

import numpy as np
from colift.agents.agent import Agent, Observation
from colift.agents.humans import SUBJECTS
from colift.agents.humans.ball import BallPartner, BallSenses
from colift.agents.observations import BallObservation
from colift.benchmark.episode import metrics
from colift.benchmark.episode.level import HEIGHT_BOUND
from colift.benchmark.episode.metric import Metrics, Scores
from colift.benchmark.episode.scenario import Scenario
from colift.benchmark.episode.task import Bounds, Playing
from colift.benchmark.episode.trace import Trace
from colift.benchmark.suites.catalogue import make_scenario
from colift.benchmark.suites.suite import Suite
from colift.benchmark.tasks.ball.lift import BallLift
from colift.benchmark.tasks.ball.scores import ball_settling_ms, missed_rmse_mm, velocity_peaks
from colift.benchmark.tasks.ball.table import BALL_METRICS
from colift.benchmark.tasks.haptic import FINER, Haptic
from colift.benchmark.world import Ball, BodyParameters, BulletWorld, FarEnd, Physics
from colift.benchmark.world.table import GRAVITY, TABLE_LENGTH, WEIGHT_SHARE
from numpy.typing import NDArray

BEHAVIOURS: Final = ("ball_smooth", "ball_pause", "ball_smooth_shared", "ball_pause_shared")

BALL: Final = Ball()
"""The ball of the suite."""

FELL: Final = "the ball rolled off the table"
"""Reason for the end of a lift in which the ball is lost."""


@dataclass(frozen=True, kw_only=True)
class BallSteering(Haptic):
    """Steer the ball to its target place on the table, while the human lifts and lowers it.

    The robot has :class:`.BallObservation`, with the target if both know it. The human has
    :class:`.BallSenses`, the seen ball, and :class:`.HumanObservation`.
    """

    name: ClassVar[str] = "ball"
    metrics: ClassVar[Metrics] = BALL_METRICS
    second_human: ClassVar[type[Agent]] = BallPartner
    ball: Ball = BALL

    def world(
        self, human: BodyParameters, far_end: FarEnd, *, physics: Physics = FINER
    ) -> BulletWorld:
        """Return a world with a ball on the table."""
        return BulletWorld(human, far_end, physics=physics, touch=True, ball=self.ball)

    def lift(self, scenario: Scenario) -> BallLift:
        """Return a lift whose human steers the ball."""
        return BallLift(scenario)

    def robot_observation(self, lift: Playing) -> Observation:
        """Return the robot's senses, laid out as :class:`.BallObservation`."""
        assert isinstance(lift, BallLift)
        return np.concatenate((lift.haptic_view(), lift.ball_view()))

    def human_observation(self, lift: Playing) -> Observation:
        """Return the human's view of the ball, and the human's senses."""
        assert isinstance(lift, BallLift)
        return lift.person_view(super().human_observation(lift), far=False)

    def partner_observation(self, lift: Playing) -> Observation:
        """Return the same for a second human in the robot's place."""
        assert isinstance(lift, BallLift)
        return lift.person_view(super().partner_observation(lift), far=True)

    def robot_bounds(self) -> Bounds:
        """Return the bounds of :class:`.BallObservation`."""
        low, high = super().robot_bounds()
        ball = np.full(len(BallObservation) - len(low), HEIGHT_BOUND)
        ball[-1] = 1.0
        lowest = -ball
        lowest[-1] = 0.0
        return np.concatenate((low, lowest)), np.concatenate((high, ball))

    def human_bounds(self, frames: int) -> Bounds:
        """Return the bounds of the humans' observations."""
        low, high = super().human_bounds(frames)
        ball = np.full(BallSenses.SIZE, HEIGHT_BOUND)
        return np.concatenate((-ball, low)), np.concatenate((ball, high))

    def rewards(self, lift: Playing) -> tuple[float, float]:
        """Return minus the distance of the ball from its target [m], for both."""
        assert isinstance(lift, BallLift)
        missed = abs(lift.world.ball_place[-1] - float(lift.place[lift.frame - 1]))
        return -missed, -missed

    def failure(self, lift: Playing) -> str | None:
        """Return how the table was dropped or the ball lost in the step just made, or None."""
        assert isinstance(lift, BallLift)
        farthest = max(map(abs, lift.world.ball_place[-lift.frames_per_step :]))
        return FELL if farthest > TABLE_LENGTH / 2 else super().failure(lift)

    def series(self, lift: Playing) -> Mapping[str, NDArray[np.float64]]:
        """Return the places of the ball and of its target, and the torque of the robot's hands."""
        assert isinstance(lift, BallLift)
        frames, world = lift.frame, lift.world
        return {
            "ball": np.array(world.ball_place[-frames:][:frames]),
            "ball_target": lift.place[:frames],
            "robot_torque": np.array(world.robot_torque[-frames:][:frames]),
        }

    def score(self, lift: Playing, trace: Trace, *, failed: bool) -> Scores:
        """Return the scores of :data:`.BALL_METRICS`."""
        place, target = trace.added["ball"], trace.added["ball_target"]
        felt = trace.human_force - WEIGHT_SHARE - self.ball.mass * GRAVITY / 2
        nan, empty = math.nan, len(place) == 0
        peaks, speed = (nan, nan) if failed else velocity_peaks(place, target)
        lost = not empty and bool(np.abs(place[-lift.frames_per_step :]).max() > TABLE_LENGTH / 2)
        return {
            "rmse_mm": missed_rmse_mm(place - target, lift.horizon),
            "settling_ms": nan if failed else ball_settling_ms(place - target, target),
            "velocity_peaks": peaks,
            "peak_speed_m_s": speed,
            "fallen": float(lost),
            "level_mm": nan
            if empty
            else metrics.rmse_mm(trace.human_end, trace.robot_end, horizon=len(place)),
            "human_force_n": nan if empty else metrics.human_force_n(felt),
            "clipped": lift.clipped(trace.action),
        }


def ball_suite() -> Suite:
    """5 subjects x 4 behaviours x 5 lifts: a ball that both steer."""
    scenarios = tuple(
        make_scenario(behaviour, subject, task=BallSteering.name)
        for behaviour in BEHAVIOURS
        for subject in SUBJECTS
    )
    return Suite(name="ball-v1", scenarios=scenarios, seeds=tuple(range(5)))
