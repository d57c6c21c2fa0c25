"""A lift with a pause on the way (figure 6 of the paper)."""

from dataclasses import dataclass

import numpy as np
from colift.agents.humans.movement import MovementDraw, interpolate, natural_stroke
from colift.agents.humans.plan import Plan, Segment, assemble, move, still
from colift.agents.humans.stroke import Motion, replan
from colift.agents.humans.subject import Subject


@dataclass(frozen=True, kw_only=True)
class Pause:
    """Stops on the way, stands still for a while, then continues."""

    height: tuple[float, float] = (0.3, 0.7)
    """Lowest and highest pause, relative to the lift's height."""
    length: tuple[float, float] = (0.8, 2.0)
    """Shortest and longest standstill [s]; the paper's figure 6 shows about 2 s."""
    braking: tuple[float, float] = (0.4, 0.7)
    """Shortest and longest braking [s]."""
    lowering_probability: float = 0.25
    """Probability of a pause on the way down instead of on the way up."""

    def plan(self, subject: Subject, seed: int) -> Plan:
        """Return the plan of one episode; pure in ``(self, subject, seed)``."""
        rng = np.random.default_rng(seed)
        lift = MovementDraw.sample(subject, rng)
        direction, height, braking, length = rng.random(4).tolist()
        up = natural_stroke(subject, lift.height, lift.up, rng)
        down = natural_stroke(subject, -lift.height, lift.down, rng)
        down[0] += lift.height
        rise: tuple[Segment, ...] = (move("rise", up[0]),)
        lower: tuple[Segment, ...] = (move("lower", down[0]),)

        stop = lift.height * interpolate(self.height, height)
        brake = interpolate(self.braking, braking)
        rest = still("pause", stop, interpolate(self.length, length))
        remaining = -stop if direction < self.lowering_probability else lift.height - stop
        onwards = natural_stroke(subject, remaining, lift.duration(remaining), rng)
        resume = move("resume", stop + onwards[0])
        if direction < self.lowering_probability:
            lower = (*_brake("lower", down, stop, brake), rest, resume)
        else:
            rise = (*_brake("rise", up, stop, brake), rest, resume)
        return assemble(
            still("ready", 0.0, lift.before),
            *rise,
            still("hold", lift.height, lift.hold),
            *lower,
            still("rest", 0.0, lift.after),
        )


def _brake(name: str, motion: Motion, stop: float, duration: float) -> tuple[Segment, Segment]:
    """Return the motion and the brake of that duration [s] that ends at ``stop`` [m].

    A constant brake from velocity v covers ``v * duration / 2``.
    """
    direction = np.sign(motion[0, -1] - stop)
    reach = direction * (motion[0] + 0.5 * duration * motion[1] - stop)
    last = int(np.argmax(reach >= 0.0))
    braked = replan(motion[:, last], stop, duration)
    return move(name, motion[0, : last + 1]), move("brake", braked[0])
