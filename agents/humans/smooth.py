"""The ordinary lift: up, hold, down."""

from dataclasses import dataclass

import numpy as np
from colift.agents.humans.movement import MovementDraw, natural_stroke
from colift.agents.humans.plan import Plan, assemble, move, still
from colift.agents.humans.subject import Subject


@dataclass(frozen=True, kw_only=True)
class Smooth:
    """Lifts to a random height and lowers again, smoothly."""

    def plan(self, subject: Subject, seed: int) -> Plan:
        """Return the plan of one episode; pure in ``(subject, seed)``."""
        rng = np.random.default_rng(seed)
        lift = MovementDraw.sample(subject, rng)
        up = natural_stroke(subject, lift.height, lift.up, rng)[0]
        down = natural_stroke(subject, -lift.height, lift.down, rng)[0]
        return assemble(
            still("ready", 0.0, lift.before),
            move("rise", up),
            still("hold", lift.height, lift.hold),
            move("lower", lift.height + down),
            still("rest", 0.0, lift.after),
        )
