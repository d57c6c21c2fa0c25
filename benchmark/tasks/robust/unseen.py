"""Behaviours for tests alone: no trainer of colift learns from them."""

from dataclasses import dataclass
from typing import ClassVar, Protocol, runtime_checkable

import numpy as np
from colift.agents.humans import Plan, Subject
from colift.agents.humans.movement import MovementDraw, interpolate, natural_stroke
from colift.agents.humans.plan import Segment, assemble, move, still

Range = tuple[float, float]


@runtime_checkable
class Unseen(Protocol):
    """A behaviour from which no trainer learns."""

    @property
    def unseen(self) -> bool:
        """True."""


@dataclass(frozen=True, kw_only=True)
class Waltz:
    """Lifts and lowers in bars of three beats: a long movement, two short ones, rests between."""

    unseen: ClassVar[bool] = True
    long: Range = (0.45, 0.6)
    """Smallest and largest share of the first beat in a stroke; the others share the rest."""
    rest: Range = (0.0, 0.12)
    """Shortest and longest rest between two beats [s]; the same in all of a lift."""

    def plan(self, subject: Subject, seed: int) -> Plan:
        """Return the plan of one episode; pure in ``(self, subject, seed)``."""
        rng = np.random.default_rng(seed)
        lift = MovementDraw.sample(subject, rng)
        long, rest = rng.random(2).tolist()
        first, pause = interpolate(self.long, long), interpolate(self.rest, rest)
        beats = first, (1.0 - first) / 2, (1.0 - first) / 2
        segments: list[Segment] = [still("ready", 0.0, lift.before)]
        height = 0.0
        for name, rise, whole in (
            ("rise", lift.height, lift.up),
            ("lower", -lift.height, lift.down),
        ):
            for beat in beats:
                step = natural_stroke(subject, beat * rise, beat * whole, rng)[0]
                segments += [move(name, height + step), still("beat", height + beat * rise, pause)]
                height += beat * rise
            segments.append(still("hold" if rise > 0.0 else "rest", max(height, 0.0), lift.hold))
            height = lift.height if rise > 0.0 else 0.0
        return assemble(*segments, still("rest", 0.0, lift.after))


@dataclass(frozen=True, kw_only=True)
class DoublePump:
    """Swings the table up and down twice, as to gain momentum, before lifting it."""

    unseen: ClassVar[bool] = True
    size: Range = (0.02, 0.05)
    """Lowest and highest swing [m]; the second is higher by half."""
    duration: Range = (0.4, 0.7)
    """Shortest and longest movement up, or down, of a swing [s]."""

    def plan(self, subject: Subject, seed: int) -> Plan:
        """Return the plan of one episode; pure in ``(self, subject, seed)``."""
        rng = np.random.default_rng(seed)
        lift = MovementDraw.sample(subject, rng)
        size, duration = rng.random(2).tolist()
        swing, time = interpolate(self.size, size), interpolate(self.duration, duration)
        segments: list[Segment] = [still("ready", 0.0, lift.before)]
        for height in (swing, 1.5 * swing):
            segments.append(move("pump", natural_stroke(subject, height, time, rng)[0]))
            segments.append(move("fall", height + natural_stroke(subject, -height, time, rng)[0]))
        up = natural_stroke(subject, lift.height, lift.up, rng)[0]
        down = natural_stroke(subject, -lift.height, lift.down, rng)[0]
        return assemble(
            *segments,
            move("rise", up),
            still("hold", lift.height, lift.hold),
            move("lower", lift.height + down),
            still("rest", 0.0, lift.after),
        )
