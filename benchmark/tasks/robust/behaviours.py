"""The behaviours of people with habits: they wait, dip, stop, turn back, or slow down."""

from dataclasses import dataclass
from typing import ClassVar

import numpy as np
from colift.agents.humans import ChangingGoal, Pause, Plan, Subject
from colift.agents.humans.movement import MovementDraw, interpolate, natural_stroke
from colift.agents.humans.person import Person
from colift.agents.humans.plan import assemble, move, still
from colift.benchmark.tasks.robust.habits import habits_of
from colift.benchmark.tasks.robust.patient import SLOWS_DOWN

Range = tuple[float, float]


def around(habit: float, spread: float) -> Range:
    """Return the range of a lift's number about a person's habit, ``spread`` to either side."""
    return habit - spread, habit + spread


@dataclass(frozen=True, kw_only=True)
class Wait:
    """Waits before lifting, and again at the top, for as long as this person usually does."""

    spread: Range = (0.7, 1.2)
    """Shortest and longest wait before the lift, relative to the person's mean."""
    top: Range = (0.1, 0.6)
    """The same at the top."""

    def plan(self, subject: Subject, seed: int) -> Plan:
        """Return the plan of one episode; pure in ``(self, subject, seed)``."""
        rng = np.random.default_rng(seed)
        lift, mean = MovementDraw.sample(subject, rng), habits_of(subject).wait
        before, top = rng.random(2).tolist()
        up = natural_stroke(subject, lift.height, lift.up, rng)[0]
        down = natural_stroke(subject, -lift.height, lift.down, rng)[0]
        return assemble(
            still("ready", 0.0, mean * interpolate(self.spread, before)),
            move("rise", up),
            still("hold", lift.height, lift.hold + mean * interpolate(self.top, top)),
            move("lower", lift.height + down),
            still("rest", 0.0, lift.after),
        )


@dataclass(frozen=True, kw_only=True)
class Dip:
    """Begins with a movement the wrong way: down before lifting, and up before lowering."""

    spread: Range = (0.7, 1.2)
    """Smallest and largest dip, relative to the person's mean."""
    duration: Range = (0.35, 0.7)
    """Shortest and longest movement the wrong way [s]."""
    above: float = 0.6
    """Movement up before lowering, relative to the dip before lifting."""

    def plan(self, subject: Subject, seed: int) -> Plan:
        """Return the plan of one episode; pure in ``(self, subject, seed)``."""
        rng = np.random.default_rng(seed)
        lift, habit = MovementDraw.sample(subject, rng), habits_of(subject).dip
        size, first, last = rng.random(3).tolist()
        dip = habit * interpolate(self.spread, size)
        top = lift.height
        sink = natural_stroke(subject, -dip, interpolate(self.duration, first), rng)[0]
        up = natural_stroke(subject, top + dip, lift.up, rng)[0]
        swing = natural_stroke(subject, self.above * dip, interpolate(self.duration, last), rng)[0]
        down = natural_stroke(subject, -top - self.above * dip, lift.down, rng)[0]
        return assemble(
            still("ready", 0.0, lift.before),
            move("dip", sink),
            move("rise", up - dip),
            still("hold", top, lift.hold),
            move("swing", top + swing),
            move("lower", top + self.above * dip + down),
            still("rest", 0.0, lift.after),
        )


@dataclass(frozen=True, kw_only=True)
class Stop:
    """Stops on the way, about where this person usually does; see :class:`.Pause`."""

    spread: float = 0.08
    """Deviation of the height from the person's mean, relative to the lift's height."""
    length: Range = (0.3, 2.5)
    """Shortest and longest standstill [s]."""
    lowering_probability: float = 0.4
    """Probability of a stop on the way down instead of on the way up."""

    def plan(self, subject: Subject, seed: int) -> Plan:
        """Return the plan of one episode; pure in ``(self, subject, seed)``."""
        pause = Pause(
            height=around(habits_of(subject).stop, self.spread),
            length=self.length,
            lowering_probability=self.lowering_probability,
        )
        return pause.plan(subject, seed)


@dataclass(frozen=True, kw_only=True)
class TurnBack:
    """Turns back on the way up, about when this person usually does; see :class:`.ChangingGoal`."""

    spread: float = 0.08
    """Deviation from the person's means, relative to the stroke's duration and height."""

    def plan(self, subject: Subject, seed: int) -> Plan:
        """Return the plan of one episode; pure in ``(self, subject, seed)``."""
        habits = habits_of(subject)
        changing = ChangingGoal(
            changes=("reverse",),
            part=around(habits.turn, self.spread),
            size=around(habits.back, self.spread),
        )
        return changing.plan(subject, seed)


@dataclass(frozen=True, kw_only=True)
class Follow:
    """Lifts and lowers smoothly, and slows down for a robot that lags."""

    rules: ClassVar[Person] = SLOWS_DOWN
    after: Range = (2.0, 3.0)
    """Shortest and longest rest after the lowering [s]: the time for those who were slowed down."""

    def plan(self, subject: Subject, seed: int) -> Plan:
        """Return the plan of one episode; pure in ``(self, subject, seed)``."""
        rng = np.random.default_rng(seed)
        lift = MovementDraw.sample(subject, rng)
        up = natural_stroke(subject, lift.height, lift.up, rng)[0]
        down = natural_stroke(subject, -lift.height, lift.down, rng)[0]
        return assemble(
            still("ready", 0.0, lift.before),
            move("rise", up),
            still("hold", lift.height, lift.hold),
            move("lower", lift.height + down),
            still("rest", 0.0, interpolate(self.after, float(rng.random()))),
        )
