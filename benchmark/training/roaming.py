"""A person who lifts in irregular ways, for training robots only: it is in no suite."""

import math
from dataclasses import dataclass

import numpy as np
from colift.agents.agent import FRAME
from colift.agents.humans import GOAL_RANGE, Plan, Subject
from colift.agents.humans.movement import REST_AFTER, REST_BEFORE, interpolate, interpolate_log
from colift.agents.humans.plan import Segment, assemble, move, still
from colift.agents.humans.stroke import Motion, replan, stroke
from numpy.typing import NDArray

LOWEST = -0.02
"""Lowest height of the motion [m]: inside the robot's stroke."""


@dataclass(frozen=True, kw_only=True)
class Roaming:
    """Moves from goal to goal, some of them given up half-way, at an individual pace.

    It is less regular than any of the suites' behaviours: heights, speeds, skews and rests are
    spread more widely, so that a learner does not overfit to the habits of a few.
    """

    goals: tuple[int, int] = (2, 6)
    """Fewest and most goals before the last, which is the rest height."""
    peak_speed: tuple[float, float] = (0.05, 0.30)
    """Lowest and highest pace of a lift [m/s], uniform in its logarithm; moves vary about it."""
    shortest: tuple[float, float] = (0.4, 0.8)
    """Shortest duration of a move [s], drawn for each."""
    skew: tuple[float, float] = (0.35, 0.65)
    """Range of the relative time of the highest speed."""
    given_up: float = 0.5
    """Fraction of the moves that are given up for the next, after the part ``progress``."""
    progress: tuple[float, float] = (0.3, 0.95)
    """Fraction of a move that is carried out before it is given up."""
    hold: tuple[float, float] = (0.1, 1.0)
    """Shortest and longest rest at a goal [s]; half of the goals have none."""

    def plan(self, subject: Subject, seed: int) -> Plan:
        """Return the plan of one episode; pure in ``(self, seed)``."""
        rng = np.random.default_rng(seed)
        pace = interpolate_log(self.peak_speed, rng.random())
        segments: list[Segment] = [still("ready", 0.0, interpolate(REST_BEFORE, rng.random()))]
        state = np.zeros(3)
        fewest, most = self.goals
        for _ in range(int(rng.integers(fewest, most + 1))):
            goal = interpolate((0.0, GOAL_RANGE[1]), rng.random())
            motion = self._motion(state, goal, pace, rng)
            if rng.random() < self.given_up:
                motion = motion[
                    :, : max(int(motion.shape[1] * interpolate(self.progress, rng.random())), 1)
                ]
                segments.append(move("go", motion[0]))
                state = motion[:, -1]
                continue
            segments.append(move("go", motion[0]))
            state = np.array([goal, 0.0, 0.0])
            if rng.random() < 0.5:
                segments.append(still("hold", goal, interpolate(self.hold, rng.random())))
        segments.append(move("lower", self._motion(state, 0.0, pace, rng)[0]))
        segments.append(still("rest", 0.0, interpolate(REST_AFTER, rng.random())))
        return assemble(*segments)

    def _motion(
        self, state: NDArray[np.float64], goal: float, pace: float, rng: np.random.Generator
    ) -> Motion:
        """Return the motion from a state to rest at a goal; slower if it would leave the range."""
        distance = goal - float(state[0])
        peak = pace * math.exp(0.3 * rng.standard_normal())
        # The peak speed of a minimum-jerk movement is 1.875 times its mean.
        duration = max(1.875 * abs(distance) / peak, interpolate(self.shortest, rng.random()))
        skew = interpolate(self.skew, rng.random())
        if not state[1:].any():
            motion = stroke(distance, duration, skew=skew)
            motion[0] += state[0]
            return motion
        motion = replan(state, goal, duration)
        while motion[0].max() > GOAL_RANGE[1] or motion[0].min() < LOWEST:
            duration *= 0.8
            motion = replan(state, goal, duration)
            if duration < 10 * FRAME:
                break
        return motion
