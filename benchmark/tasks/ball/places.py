"""Plans with a ball: the lift, and the places where the ball should be."""

import math
from dataclasses import dataclass
from typing import ClassVar, Final

import numpy as np
from colift.agents.agent import FRAME
from colift.agents.humans import Behaviour, Pause, Plan, Smooth, Subject
from colift.agents.humans.plan import LENGTH_STEP
from colift.agents.humans.subject import GOAL_RANGE
from numpy.typing import NDArray

FIRST: Final = (0.0, 0.5)
"""Range of the time from the beginning of the lift to the first change of the target [s]."""

STAY: Final = (2.4, 3.2)
"""Range of the time from there to the next change [s]."""

LAST: Final = 2.0
"""Least time of the last target [s]."""

CARRYING: Final = (2.0, 3.0)
"""Range of the time by which the table is held longer than without a ball [s]."""

HEIGHT_SHARE: Final = 0.15
"""Height of the lift above the lowest goal, relative to that without a ball: the ends need room
above and below."""

FARTHEST: Final = 0.2
"""Largest distance of a target from the table's middle [m]: half of the way to the edge."""

WAY: Final = (0.1, 0.25)
"""Range of the distance between successive targets [m]."""

STRONGEST: Final = 0.5
"""Largest acceleration of a moving target [m/s2]: the ball's on a table inclined by 4 degrees."""


@dataclass(frozen=True, kw_only=True, eq=False)
class BallPlan(Plan):
    """A plan that also has the intended place of the ball."""

    place: NDArray[np.float64]
    """(n,) place [m] where the ball should be at the end of each frame, read-only."""
    shown: bool
    """Whether the partner knows that place."""


@dataclass(frozen=True, kw_only=True)
class Placing:
    """Lifts as another behaviour does, with a target for the ball that moves on now and then.

    The target moves with minimum jerk, as hands do, and just slowly enough for the ball to follow.
    """

    lifting: ClassVar[Behaviour]
    """The behaviour of the lift."""
    shown: ClassVar[bool] = False
    """Whether the partner knows the target."""

    def plan(self, subject: Subject, seed: int) -> BallPlan:
        """Return the plan of one episode; pure in ``(self, subject, seed)``."""
        lift = self.lifting.plan(subject, seed)
        rng = np.random.default_rng((seed, 0xBA11))
        lowest = GOAL_RANGE[0]
        scale = (lowest + HEIGHT_SHARE * (lift.goal - lowest)) / lift.goal
        held = next(frame for name, frame in lift.events if name == "hold")
        longer = round(float(rng.uniform(*CARRYING)) / FRAME / LENGTH_STEP) * LENGTH_STEP
        heights = scale * lift.target
        target = np.concatenate((heights[:held], np.full(longer, heights[held]), heights[held:]))
        strokes = [_later(held, longer, *stroke) for stroke in lift.strokes]
        events = [(name, frame + longer * (frame > held)) for name, frame in lift.events]

        place = np.zeros(len(target))
        start, here = strokes[0][0] * FRAME + float(rng.uniform(*FIRST)), 0.0
        while start <= len(place) * FRAME - LAST:
            there = _next(here, rng)
            frame = round(start / FRAME)
            path = _path(there - here)
            place[frame:] = there
            place[frame : frame + len(path)] = here + path
            here = there
            events.append(("target", frame))
            start += float(rng.uniform(*STAY))
        target.flags.writeable = False
        place.flags.writeable = False
        return BallPlan(
            target=target,
            strokes=tuple(strokes),
            goal=float(target.max()),
            events=tuple(sorted(events, key=lambda event: event[1])),
            place=place,
            shown=self.shown,
        )


def _later(held: int, longer: int, start: int, stop: int) -> tuple[int, int]:
    """Return a stroke with ``longer`` frames inserted at frame ``held``."""
    return start + longer * (start >= held), stop + longer * (stop > held)


def _next(here: float, rng: np.random.Generator) -> float:
    """Return the next target within reach."""
    while True:
        there = float(rng.uniform(-FARTHEST, FARTHEST))
        if WAY[0] <= abs(there - here) <= WAY[1]:
            return there


def _path(way: float) -> NDArray[np.float64]:
    """Return a minimum-jerk movement over a way [m], with a peak acceleration of STRONGEST."""
    peak = 10 / math.sqrt(3)
    frames = round(math.sqrt(peak * abs(way) / STRONGEST) / FRAME)
    t = np.arange(1, frames + 1) / frames
    return np.asarray(way * t**3 * (10 - 15 * t + 6 * t**2))


@dataclass(frozen=True, kw_only=True)
class BallSmooth(Placing):
    """A smooth lift; only the human knows the target."""

    lifting: ClassVar[Behaviour] = Smooth()


@dataclass(frozen=True, kw_only=True)
class BallPause(Placing):
    """A lift with a pause on the way; only the human knows the target."""

    lifting: ClassVar[Behaviour] = Pause()


@dataclass(frozen=True, kw_only=True)
class BallSmoothShared(BallSmooth):
    """A smooth lift; both know the target."""

    shown: ClassVar[bool] = True


@dataclass(frozen=True, kw_only=True)
class BallPauseShared(BallPause):
    """A lift with a pause on the way; both know the target."""

    shown: ClassVar[bool] = True
