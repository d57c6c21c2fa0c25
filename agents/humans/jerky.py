"""A lift in irregular submovements."""

from dataclasses import dataclass

import numpy as np
from colift.agents.humans.movement import MovementDraw, interpolate
from colift.agents.humans.plan import Plan, assemble, move, still
from colift.agents.humans.stroke import Motion, Submovement, stroke
from colift.agents.humans.subject import Subject


@dataclass(frozen=True, kw_only=True)
class Jerky:
    """Moves jerkily: two to three submovements per second."""

    frequency: tuple[float, float] = (2.0, 3.0)
    """Lowest and highest rate of submovements [Hz]; a choice, on the fast side of the 0.5 to 1.8 Hz
    in which Miall, Weir and Stein (J. Mot. Behav. 25, 1993) saw visual tracking intermit."""
    size: tuple[float, float] = (0.05, 0.20)
    """Lowest and highest displacement of a submovement, relative to the stroke's."""
    filling: float = 0.9
    """Duration of a submovement, relative to the interval between two."""
    jitter: float = 0.1
    """Latest onset of a submovement after its regular time, relative to the interval."""
    total: float = 0.9
    """Highest displacement of all submovements together, relative to the stroke's."""

    def plan(self, subject: Subject, seed: int) -> Plan:
        """Return the plan of one episode; pure in ``(self, subject, seed)``."""
        rng = np.random.default_rng(seed)
        lift = MovementDraw.sample(subject, rng)
        interval = 1.0 / interpolate(self.frequency, float(rng.random()))
        up = self._stroke(lift.height, lift.up, subject.skew_up, interval, rng)
        down = self._stroke(-lift.height, lift.down, subject.skew_down, interval, rng)
        return assemble(
            still("ready", 0.0, lift.before),
            move("rise", up[0]),
            still("hold", lift.height, lift.hold),
            move("lower", lift.height + down[0]),
            still("rest", 0.0, lift.after),
        )

    def _stroke(
        self,
        rise: float,
        duration: float,
        skew: float,
        interval: float,
        rng: np.random.Generator,
    ) -> Motion:
        lasting = min(self.filling * interval, duration)
        latest = min(self.jitter * interval, duration - lasting)
        count = int((duration - lasting - latest) / interval) + 1
        low, high = self.size
        surplus = rng.random(count)
        surplus *= min(high - low, (self.total - count * low) / surplus.sum())
        pieces = [
            Submovement(
                start=index * interval + latest * delay, duration=lasting, rise=rise * (low + more)
            )
            for index, (delay, more) in enumerate(
                zip(rng.random(count).tolist(), surplus.tolist(), strict=True)
            )
        ]
        return stroke(rise, duration, skew=skew, extra=pieces)
