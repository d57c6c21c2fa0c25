"""Plans with hurdles: private heights to pass on the way, in private windows of time."""

from dataclasses import dataclass
from typing import ClassVar, Final, NamedTuple

import numpy as np
from colift.agents.agent import FRAME
from colift.agents.humans import Plan, Subject
from colift.agents.humans.movement import MovementDraw, natural_stroke
from colift.agents.humans.plan import assemble, move, still

COMMON: Final = (0.13, 0.17)
"""Range of the common height, to which both ends are lifted [m]."""

AWAY: Final = (0.03, 0.05)
"""Range of the distance of a hurdle from the common height, above or below [m]."""

APART: Final = (0.02, 0.1)
"""Range of the distance between the two hurdles of a lift [m]."""

FIRST: Final = (0.4, 0.7)
"""Range of the time from the end of the rise until the first window opens [s]."""

LENGTH: Final = (1.7, 2.0)
"""Range of the length of a window [s]: room for two passages, each with a stay."""

LEFT: Final = (0.3, 0.5)
"""Range of the time from the end of the last window to the lowering [s]."""


class Hurdle(NamedTuple):
    """A height to pass, and when."""

    height: float
    """[m]"""
    start: int
    """First frame of its window."""
    stop: int
    """Frame after its last."""


@dataclass(frozen=True, kw_only=True, eq=False)
class HurdlePlan(Plan):
    """A plan whose target is the common way of both ends, with the private hurdles beside it."""

    own: Hurdle | None
    """The human's hurdle, known to the human alone."""
    other: Hurdle | None
    """The hurdle of the far end's holder, known to that holder alone."""
    agreeing: tuple[int, int]
    """First frame at the common height and the frame after the last: the part in which there is
    something to agree on."""


@dataclass(frozen=True, kw_only=True)
class Abreast:
    """Lifts to a common height and lowers again; on the way both have a hurdle, at a time.

    Both windows open within 0.1 s of each other: the order is free.
    """

    has: ClassVar[tuple[bool, bool]] = (True, True)
    """Whether the human and the far end's holder have a hurdle."""
    ahead: ClassVar[tuple[float, float]] = (-0.1, 0.1)
    """Range of the time by which the human's window opens before the other [s]."""

    def plan(self, subject: Subject, seed: int) -> HurdlePlan:
        """Return the plan of one episode; pure in ``(self, subject, seed)``."""
        rng = np.random.default_rng(seed)
        draw = MovementDraw.sample(subject, rng)
        common = float(rng.uniform(*COMMON))
        up = natural_stroke(subject, common, draw.duration(common), rng)[0]
        down = natural_stroke(subject, -common, draw.duration(-common), rng)[0]
        heights = self._heights(common, rng)
        ahead = float(rng.uniform(*self.ahead))
        delays = float(rng.uniform(*FIRST)) + np.array((max(-ahead, 0.0), max(ahead, 0.0)))
        starts = delays.tolist()
        stops = (delays + rng.uniform(*LENGTH, 2)).tolist()
        hold = max(stops) + float(rng.uniform(*LEFT))
        plan = assemble(
            still("ready", 0.0, draw.before),
            move("rise", up),
            still("hold", common, hold),
            move("lower", common + down),
            still("rest", 0.0, draw.after),
        )
        top, end = plan.events[2][1], plan.events[3][1]
        own, other = (
            Hurdle(height, top + round(start / FRAME), top + round(stop / FRAME)) if given else None
            for height, start, stop, given in zip(heights, starts, stops, self.has, strict=True)
        )
        return HurdlePlan(
            target=plan.target,
            strokes=plan.strokes,
            goal=plan.goal,
            events=plan.events,
            own=own,
            other=other,
            agreeing=(top, end),
        )

    def _heights(self, common: float, rng: np.random.Generator) -> list[float]:
        """Return the heights of both hurdles, far enough from each other."""
        low, high = APART
        while True:
            signs = rng.choice((-1.0, 1.0), 2)
            own, other = (common + signs * rng.uniform(*AWAY, 2)).tolist()
            if low <= abs(own - other) <= high:
                return [own, other]


@dataclass(frozen=True, kw_only=True)
class Ahead(Abreast):
    """Both have a hurdle; the human's window opens 0.2 to 0.4 s before the other."""

    ahead: ClassVar[tuple[float, float]] = (0.2, 0.4)


@dataclass(frozen=True, kw_only=True)
class Behind(Abreast):
    """Both have a hurdle; the human's window opens 0.2 to 0.4 s after the other."""

    ahead: ClassVar[tuple[float, float]] = (-0.4, -0.2)


@dataclass(frozen=True, kw_only=True)
class OwnHurdle(Abreast):
    """The human alone has a hurdle."""

    has: ClassVar[tuple[bool, bool]] = (True, False)


@dataclass(frozen=True, kw_only=True)
class OtherHurdle(Abreast):
    """The holder of the far end alone has a hurdle."""

    has: ClassVar[tuple[bool, bool]] = (False, True)


@dataclass(frozen=True, kw_only=True)
class NoHurdle(Abreast):
    """Neither has a hurdle, and neither knows that the other has none."""

    has: ClassVar[tuple[bool, bool]] = (False, False)
