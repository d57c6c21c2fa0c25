"""The task to steer a ball on the table to a target place, and its suite."""

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, ClassVar, Final, NamedTuple

import numpy as np
from colift.agents.agent import HISTORY, Agent, Observation
from colift.agents.humans import Plan
from colift.agents.humans.person import Person
from colift.agents.rules import ArrayFunctions, Drawn, N, View
from colift.agents.senses import HEIGHT_BOUND, Sense
from colift.agents.tasks.ball.observation import BALL_SENSES
from colift.benchmark.episode import metrics
from colift.benchmark.episode.lift import lasting
from colift.benchmark.episode.metric import Metrics, Scores
from colift.benchmark.episode.task import Bounds, Playing
from colift.benchmark.episode.trace import Trace
from colift.benchmark.suites.people import people_suite
from colift.benchmark.suites.ranges import BALL_PEOPLE
from colift.benchmark.suites.suite import Suite
from colift.benchmark.tasks.ball.person import Steers
from colift.benchmark.tasks.ball.places import BallPlan
from colift.benchmark.tasks.ball.scores import ball_settling_ms, velocity_peaks
from colift.benchmark.tasks.ball.second import BallPartner, BallSenses, with_ball
from colift.benchmark.tasks.ball.table import BALL_METRICS
from colift.benchmark.tasks.touch import Touch, torque_of
from colift.benchmark.world.ball import Ball
from colift.benchmark.world.table import GRAVITY, TABLE_LENGTH, WEIGHT_SHARE
from numpy.typing import NDArray

BALL: Final = Ball()
"""The ball of the suite."""

FELL: Final = "the ball rolled off the table"
"""Reason for the end of a lift in which the ball is lost."""


class Places(NamedTuple):
    """The task's series."""

    place: Any
    """Intended place of the ball at the end of each frame [m]."""


class Shown(NamedTuple):
    """The task's numbers."""

    shown: Any
    """1 if both know the target, 0 if the human alone does."""


@dataclass(frozen=True, kw_only=True)
class BallSteering(Touch):
    """Steer the ball to its target place on the table, while the human lifts and lowers it.

    The robot has :class:`.BallObservation`, with the target if both know it. The human has
    :class:`.BallSenses`, the seen ball, and :class:`.HumanObservation`.
    """

    name: ClassVar[str] = "ball"
    metrics: ClassVar[Metrics] = BALL_METRICS
    person: ClassVar[Person] = Steers()
    second_human: ClassVar[type[Agent]] = BallPartner
    behaviours: ClassVar[tuple[str, ...]] = (
        "ball_smooth",
        "ball_pause",
        "ball_smooth_shared",
        "ball_pause_shared",
    )
    senses: ClassVar[tuple[Sense, ...]] = BALL_SENSES
    ball: Ball = BALL

    @property
    def rolling(self) -> Ball:
        """The ball."""
        return self.ball

    def setting(self, plan: Plan, frames: int, seed: Callable[[str], int]) -> tuple[Places, Shown]:
        """Return the intended places of the ball, and whether both know them."""
        if not isinstance(plan, BallPlan):
            return Places(np.zeros(frames)), Shown(0.0)
        return Places(lasting(plan.place, frames)), Shown(float(plan.shown))

    def observe(self, f: ArrayFunctions[N], drawn: Drawn[N], view: View[N]) -> Sequence[N]:
        """Return the seen place of the ball, the target, and whether that is known."""
        shown = drawn.facts.shown
        target = f.where(shown > 0.0, drawn.series.place.at(view.frame), 0.0)
        return view.seen("ball_place", view.latency), target, shown

    def missed(self, f: ArrayFunctions[N], due: Any, ends: Any) -> Sequence[N]:
        """Return the square distance of the ball from its target."""
        return ((ends.ball - due.place) ** 2,)

    def lost(self, f: ArrayFunctions[N], ends: Any) -> Any:
        """Return whether the ball has rolled off the table."""
        return f.abs(ends.ball) > TABLE_LENGTH / 2

    def failure(self, lift: Playing) -> str | None:
        """Return how the table was dropped or the ball lost in the step just made, or None."""
        return FELL if self.is_lost(lift) else super().failure(lift)

    def human_observation(self, lift: Playing) -> Observation:
        """Return the human's view of the ball, and the human's senses."""
        return _with_ball(lift, lift.human_view(lift.planned()), lift.visual, known=True)

    def second_person_observation(self, lift: Playing) -> Observation:
        """Return the same for a second human in the robot's place."""
        view = super().second_person_observation(lift)
        return _with_ball(lift, view, lift.partner_visual, known=bool(lift.facts.shown))

    def human_bounds(self, frames: int) -> Bounds:
        """Return the bounds of the humans' observations."""
        low, high = super().human_bounds(frames)
        ball = np.full(BallSenses.SIZE, HEIGHT_BOUND)
        return np.concatenate((-ball, low)), np.concatenate((ball, high))

    def series(self, lift: Playing) -> Mapping[str, NDArray[np.float64]]:
        """Return the places of the ball and of its target, and the torque of the robot's hands."""
        frames = lift.frame
        return {
            "ball": np.array(lift.world.ball_place[-frames:][:frames]),
            "ball_target": lift.due.place[:frames],
            "robot_torque": torque_of(lift),
        }

    def score(self, lift: Playing, trace: Trace, *, failed: bool) -> Scores:
        """Return the scores of :data:`.BALL_METRICS`."""
        place, target = trace.added["ball"], trace.added["ball_target"]
        felt = trace.human_force - WEIGHT_SHARE - self.ball.mass * GRAVITY / 2
        nan, empty = math.nan, len(place) == 0
        peaks, speed = (nan, nan) if failed else velocity_peaks(place, target)
        error = self.rmse_mm(lift, trace, place)
        shared = lift.facts.shown > 0.0
        lost = not empty and bool(np.abs(place[-lift.frames_per_step :]).max() > TABLE_LENGTH / 2)
        return {
            "rmse_mm": error,
            "settling_ms": nan if failed else ball_settling_ms(place - target, target),
            "shared_rmse_mm": error if shared else nan,
            "private_rmse_mm": nan if shared else error,
            "velocity_peaks": peaks,
            "peak_speed_m_s": speed,
            "fallen": float(lost),
            "level_mm": nan
            if empty
            else metrics.rmse_mm(trace.human_end, trace.robot_end, horizon=len(place)),
            "human_force_n": nan if empty else metrics.human_force_n(felt),
            "clipped": lift.clipped(trace.action),
        }


def _with_ball(lift: Playing, view: Observation, delay: int, *, known: bool) -> Observation:
    """Return a person's senses with the ball before them; see :func:`.with_ball`."""
    places = lift.world.ball_place
    seen = len(places) - delay
    coming = np.minimum(np.arange(lift.frame, lift.frame + HISTORY), lift.horizon - 1)
    return with_ball(view, places[seen - HISTORY : seen], lift.due.place[coming] if known else None)


def ball_suite() -> Suite:
    """25 people x 4 behaviours: a ball that both steer."""
    return people_suite("ball-v1", BallSteering.name, BallSteering.behaviours, BALL_PEOPLE)
