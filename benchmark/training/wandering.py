"""People for training only, with wide ranges of size, pace and persistence that no suite has."""

import math
from dataclasses import dataclass
from typing import Final

import numpy as np
from colift.agents.agent import FRAME
from colift.agents.humans import GOAL_RANGE, Plan, Subject
from colift.agents.humans.movement import REST_AFTER, REST_BEFORE, interpolate, interpolate_log
from colift.agents.humans.plan import Segment, assemble, move, still
from colift.agents.humans.stroke import replan
from numpy.typing import NDArray

LONGEST: Final = 10.0
"""Time after which no further movement begins [s]."""

LOWEST: Final = -0.03
"""Lowest height of the motion [m]: the end of the robot's stroke."""

_FEWEST_FRAMES: Final = 25


@dataclass(frozen=True, kw_only=True)
class Wandering:
    """Moves to goals near and far, at many paces, with and without rests, with a drifting hand.

    People who lift together move more slowly and with more interruptions than a single leader; the
    ranges cover both. They are drawn per lift, so that a robot with a memory can find out which
    kind of person it has.
    """

    distance: tuple[float, float] = (0.02, 0.28)
    """Shortest and longest movement [m], uniform in its logarithm; its spread is drawn per lift."""
    speed: tuple[float, float] = (0.04, 0.45)
    """Lowest and highest mean peak speed of a lift's movements [m/s], uniform in its logarithm."""
    interrupted: tuple[float, float] = (0.0, 0.5)
    """Smallest and largest share of the movements that are given up on the way."""
    resting: tuple[float, float] = (0.0, 0.6)
    """Smallest and largest share of the movements that are followed by a rest."""
    rest: tuple[float, float] = (0.05, 1.5)
    """Shortest and longest rest [s], uniform in its logarithm."""
    drift: tuple[float, float] = (5e-4, 0.05)
    """Lowest and highest speed of the hand's drift from its movement [m/s], uniform in its
    logarithm: at the highest, the drift hides a slow movement."""
    drift_time: tuple[float, float] = (0.15, 1.5)
    """Shortest and longest correlation time of that drift [s], uniform in its logarithm."""
    farthest_drift: float = 0.06
    """Largest standard deviation of the drift [m]."""

    def plan(self, subject: Subject, seed: int) -> Plan:
        """Return the plan of one episode; pure in ``(self, seed)``."""
        rng = np.random.default_rng(seed)
        pace = interpolate_log(self.speed, rng.random())
        farthest = interpolate_log((5 * self.distance[0], self.distance[1]), rng.random())
        interrupted = interpolate(self.interrupted, rng.random())
        resting = interpolate(self.resting, rng.random())
        ready = interpolate(REST_BEFORE, rng.random())
        segments: list[Segment] = [still("ready", 0.0, ready)]
        state, time = np.zeros(3), ready
        while time < LONGEST:
            distance = interpolate_log((self.distance[0], farthest), rng.random())
            up = bool(rng.random() < 0.8) if state[0] < 0.04 else bool(rng.random() < 0.5)
            goal = state[0] + (distance if up else -distance)
            goal = float(np.clip(goal, LOWEST, GOAL_RANGE[1]))
            motion = _motion(state, goal, pace * math.exp(0.4 * rng.standard_normal()))
            if rng.random() < interrupted:
                cut = max(int(motion.shape[1] * interpolate((0.2, 0.95), rng.random())), 1)
                motion = motion[:, :cut]
            segments.append(move("go", motion[0]))
            state, time = motion[:, -1], time + motion.shape[1] * FRAME
            if not np.abs(state[1:]).max() > 1e-3 and rng.random() < resting:
                pause = interpolate_log(self.rest, rng.random())
                segments.append(still("hold", float(state[0]), pause))
                time += pause
        segments.append(move("lower", _motion(state, 0.0, pace)[0]))
        segments.append(still("rest", 0.0, interpolate(REST_AFTER, rng.random())))
        plan = assemble(*segments)
        return self._drifting(plan, rng)

    def _drifting(self, plan: Plan, rng: np.random.Generator) -> Plan:
        """Return the plan with a smooth deviation that is zero at both ends."""
        count = len(plan.target)
        time = interpolate_log(self.drift_time, rng.random())
        size = min(interpolate_log(self.drift, rng.random()) * time, self.farthest_drift)
        width = time / FRAME
        bell = np.exp(-0.5 * (np.arange(-3 * int(width), 3 * int(width) + 1) / width) ** 2)
        white = rng.standard_normal(count + len(bell) - 1)
        smooth = np.convolve(white, bell / math.sqrt(float((bell**2).sum())), mode="valid")
        fade = np.minimum(np.arange(count), np.arange(count)[::-1]) / 50
        target = plan.target + size * smooth * np.minimum(fade, 1.0) ** 2
        target = np.clip(target, LOWEST, GOAL_RANGE[1])
        target.flags.writeable = False
        return Plan(
            target=target, strokes=plan.strokes, goal=float(target.max()), events=plan.events
        )


def _motion(state: NDArray[np.float64], goal: float, speed: float) -> NDArray[np.float64]:
    """Return the motion to rest at a goal; minimum jerk peaks at 1.875 times its mean speed."""
    frames = max(round(1.875 * abs(goal - float(state[0])) / speed / FRAME), _FEWEST_FRAMES)
    return replan(state, goal, frames * FRAME)
