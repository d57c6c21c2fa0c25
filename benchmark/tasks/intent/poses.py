"""Plans for the whole table: intended heights of both ends."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import ClassVar, Final, NamedTuple

import numpy as np
from colift.agents.humans import Plan, Subject
from colift.agents.humans.movement import MovementDraw, natural_stroke
from colift.agents.humans.plan import LENGTH_STEP, Segment, assemble, move, still
from numpy.typing import NDArray

BASE: Final = (0.12, 0.16)
"""Range of the height to which the table is lifted level at first [m]."""

REACH: Final = (0.06, 0.11)
"""Range of the size of the movements from there [m]."""

LOWEST, HIGHEST = 0.02, 0.27
"""Range of the intended heights of both ends between lifting and lowering [m]."""

STEEPEST: Final = 0.17
"""Largest intended height difference of the ends [m]."""

SHARES: Final = {"together": 1.0, "pivot": 0.0, "counter": -1.0}
"""Movement of the far end by intent, as a share of the near end's."""

EXCURSIONS: Final = 2
"""Movements away from the level table, each with its way back."""


@dataclass(frozen=True, kw_only=True, eq=False)
class PosePlan(Plan):
    """A plan that also has the intended heights of the far end."""

    far: NDArray[np.float64]
    """(n,) intended height [m] of the far end at the end of each frame, read-only."""


class PosePart(NamedTuple):
    """One movement: the displacement of the near end, and the far end's share of it."""

    rise: float
    share: float


@dataclass(frozen=True, kw_only=True)
class Posing:
    """Lifts the table level, moves it to other poses and back, and lowers it.

    Each excursion has one intent, or changes from one to another half-way: both ends move together,
    the near end moves alone (a pivot, as to pour), or the ends move in opposite directions.
    """

    intents: ClassVar[tuple[str, ...]] = tuple(SHARES)
    """Names of :data:`SHARES`, drawn anew for each part of an excursion."""
    parts: ClassVar[int] = 1
    """Parts of an excursion without a rest between them."""

    def plan(self, subject: Subject, seed: int) -> PosePlan:
        """Return the plan of one episode; pure in ``(self, subject, seed)``."""
        rng = np.random.default_rng(seed)
        draw = MovementDraw.sample(subject, rng)
        base = float(rng.uniform(*BASE))
        steps: list[list[PosePart]] = [[PosePart(base, 1.0)]]
        for _ in range(EXCURSIONS):
            way = self._excursion(base, rng)
            steps += [way, [PosePart(-rise, share) for rise, share in reversed(way)]]
        steps.append([PosePart(-base, 1.0)])

        segments: list[Segment] = [still("ready", 0.0, draw.before)]
        far = [segments[0].heights]
        near_height = far_height = 0.0
        for number, stroke in enumerate(steps):
            for rise, share in stroke:
                path = natural_stroke(subject, rise, draw.duration(rise), rng)[0]
                segments.append(move(_name(number, len(steps), share), near_height + path))
                far.append(far_height + share * path)
                near_height, far_height = near_height + rise, far_height + share * rise
            last = number == len(steps) - 1
            rest = draw.after if last else draw.hold + float(rng.uniform(0.2, 0.6))
            height = 0.0 if last else near_height
            segments.append(still("rest" if last else "hold", height, rest))
            far.append(np.full(len(segments[-1].heights), 0.0 if last else far_height))
        plan = assemble(*segments)
        return PosePlan(
            target=plan.target,
            strokes=plan.strokes,
            goal=plan.goal,
            events=plan.events,
            far=_whole(far),
        )

    def _excursion(self, base: float, rng: np.random.Generator) -> list[PosePart]:
        """Return the parts of an outward movement that keeps both ends within reach."""
        while True:
            way = [
                PosePart(
                    float(rng.uniform(*REACH)) / self.parts * float(rng.choice((-1.0, 1.0))),
                    SHARES[self.intents[int(rng.integers(len(self.intents)))]],
                )
                for _ in range(self.parts)
            ]
            near = base + np.cumsum([step.rise for step in way])
            far = base + np.cumsum([step.rise * step.share for step in way])
            inside = min(near.min(), far.min()) >= LOWEST and max(near.max(), far.max()) <= HIGHEST
            if inside and np.abs(near - far).max() <= STEEPEST and _differ(way):
                return way


@dataclass(frozen=True, kw_only=True)
class Together(Posing):
    """Moves both ends alike: the table stays level."""

    intents: ClassVar[tuple[str, ...]] = ("together",)


@dataclass(frozen=True, kw_only=True)
class Pivot(Posing):
    """Moves the near end alone, as to pour: the far end stays."""

    intents: ClassVar[tuple[str, ...]] = ("pivot",)


@dataclass(frozen=True, kw_only=True)
class Counter(Posing):
    """Moves the ends in opposite directions: the table turns about its middle."""

    intents: ClassVar[tuple[str, ...]] = ("counter",)


@dataclass(frozen=True, kw_only=True)
class Switching(Posing):
    """Changes the intent half-way, without a rest."""

    parts: ClassVar[int] = 2


def _differ(way: Sequence[PosePart]) -> bool:
    return len({step.share for step in way}) == len(way)


def _name(number: int, count: int, share: float) -> str:
    if number in (0, count - 1):
        return "rise" if number == 0 else "lower"
    return next(name for name, each in SHARES.items() if each == share)


def _whole(parts: Sequence[NDArray[np.float64]]) -> NDArray[np.float64]:
    """Return the heights in one array as long as the plan's own."""
    heights = np.concatenate(parts)
    missing = -len(heights) % LENGTH_STEP
    heights = np.concatenate((heights, np.full(missing, heights[-1])))
    heights.flags.writeable = False
    return heights
