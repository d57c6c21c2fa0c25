"""A person who lifts twice."""

from dataclasses import dataclass

import numpy as np
from colift.agents.humans import Plan, Subject
from colift.agents.humans.movement import MovementDraw, natural_stroke
from colift.agents.humans.plan import assemble, move, still


@dataclass(frozen=True, kw_only=True)
class Twice:
    """Lifts, lowers half way, lifts again, and lowers."""

    depth: float = 0.5
    """Height of the turn, relative to the height of the lift."""

    def plan(self, subject: Subject, seed: int) -> Plan:
        """Return the plan of one episode."""
        rng = np.random.default_rng(seed)
        lift = MovementDraw.sample(subject, rng)  # height, durations and rests of this lift
        top, low = lift.height, self.depth * lift.height
        strokes = [
            ("rise", 0.0, top),
            ("half down", top, low),
            ("rise again", low, top),
            ("lower", top, 0.0),
        ]
        segments = [still("ready", 0.0, lift.before)]
        for name, start, end in strokes:
            way = natural_stroke(subject, end - start, lift.duration(end - start), rng)
            segments += [move(name, start + way[0]), still(f"after {name}", end, lift.hold)]
        return assemble(*segments[:-1], still("rest", 0.0, lift.after))
