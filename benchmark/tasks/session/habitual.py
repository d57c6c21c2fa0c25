"""The behaviour of people with habits, who remember the lifts of a session."""

import dataclasses
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import ClassVar, Final, Self

import numpy as np
from colift.agents.agent import Agent
from colift.agents.humans import Plan, Subject
from colift.agents.humans.movement import interpolate, natural_stroke
from colift.agents.humans.person import Person
from colift.agents.humans.plan import Segment, assemble, move, still
from colift.agents.rules import SCALARS
from colift.benchmark.tasks.session.acquaintance import (
    STRANGER,
    Acquaintance,
    after_lift,
    impression,
)
from colift.benchmark.tasks.session.partner import KnowingPartner
from colift.benchmark.tasks.session.person import Helps
from colift.benchmark.tasks.session.usual import UsualLift, drawn_habits, usual_change, usual_lift

REST: Final = (3.0, 4.0)
"""Shortest and longest rest after the lowering [s]: the time for those who were slowed down."""

TIMING: Final = 0.06
"""Standard deviation of a lift's times from the usual ones, relative (assumed; people who tap or
wait without a clock deviate by 3 to 10 % of the interval)."""

SPREAD: Final = 0.03
"""Standard deviation of heights, relative (assumed)."""

FARTHEST: Final = 2.0
"""Largest deviation, in standard deviations."""

BRIEFEST: Final = 0.35
"""Shortest movement [s]."""


@dataclass(frozen=True, kw_only=True)
class Habitual:
    """Lifts in the usual way of this person, who remembers the partner from lift to lift.

    Each person has a wait, a height, durations and a way up that are similar in all lifts of a
    session, and most change one of them once (:func:`.usual_lift`). The person learns to expect the
    partner's lag, and trusts a partner who does what is expected (:func:`.after_lift`), and helps
    accordingly (:class:`.Helps`).
    """

    place: int = 0
    """Place of the lift in the session, counted from 0."""
    known: Acquaintance[float] = STRANGER
    """What the person has learned about the partner."""
    counted: int = 3
    """Lifts at the end of a session that count."""
    steady: bool = True
    """Whether there are habits; if not, they are drawn anew for each lift."""
    second_human: ClassVar[type[Agent]] = KnowingPartner

    @property
    def rules(self) -> Person:
        """The rules of this person in this lift."""
        return Helps(known=self.known)

    @property
    def trust(self) -> float:
        """Trust in the partner before this lift; see :attr:`.Acquaintance.trust`."""
        return self.known.trust

    def change(self, subject: Subject) -> int | None:
        """Return the place of the lift from which on a habit is another one; None if none is."""
        return usual_change(subject)

    def at(self, place: int) -> Self:
        """Return the behaviour in the lift at a place, of a person who has learned nothing."""
        return dataclasses.replace(self, place=place)

    def after(self, near: Sequence[float], far: Sequence[float]) -> Self:
        """Return the behaviour in the next lift; see :meth:`.Serial.after`."""
        known = self.known
        if len(near) > 1:
            known = after_lift(SCALARS, known, impression(SCALARS, near, far))
        return dataclasses.replace(self, place=self.place + 1, known=known)

    def plan(self, subject: Subject, seed: int) -> Plan:
        """Return the plan of one episode; pure in ``(self, subject, seed)``."""
        rng = np.random.default_rng(seed)
        usual = usual_lift(subject, self.place) if self.steady else drawn_habits(subject, rng)
        lift = _varied(usual, rng)
        after = interpolate(REST, float(rng.random()))
        down = natural_stroke(subject, -lift.height, lift.down, rng)[0]
        return assemble(
            still("ready", 0.0, lift.wait),
            *_way_up(subject, lift, rng),
            still("hold", lift.height, lift.hold),
            move("lower", lift.height + down),
            still("rest", 0.0, after),
        )


def _varied(usual: UsualLift, rng: np.random.Generator) -> UsualLift:
    """Return a lift that deviates from the usual one as people's lifts do."""
    lots = np.clip(rng.standard_normal(8), -FARTHEST, FARTHEST).tolist()
    times = "wait", "hold", "up", "down", "length"
    places = "height", "at", "size"
    factors = zip((*times, *places), [TIMING] * 5 + [SPREAD] * 3, lots, strict=True)
    return usual._replace(
        **{name: getattr(usual, name) * (1.0 + spread * lot) for name, spread, lot in factors}
    )


def _way_up(subject: Subject, lift: UsualLift, rng: np.random.Generator) -> Iterator[Segment]:
    """Yield the movements from rest to the height of a lift."""

    def stroke(name: str, start: float, stop: float) -> Segment:
        share = abs(stop - start) / lift.height
        duration = max(lift.up * share**0.5, BRIEFEST)
        return move(name, start + natural_stroke(subject, stop - start, duration, rng)[0])

    top, part = lift.height, lift.at * lift.height
    if lift.way == "straight":
        yield stroke("rise", 0.0, top)
    elif lift.way == "stop":
        yield stroke("rise", 0.0, part)
        yield still("pause", part, lift.length)
        yield stroke("resume", part, top)
    elif lift.way == "dip":
        dip = 0.1 * lift.size * top
        yield stroke("dip", 0.0, -dip)
        yield stroke("rise", -dip, top)
    else:
        back = part * (1.0 - lift.size)
        yield stroke("rise", 0.0, part)
        yield stroke("reverse", part, back)
        yield stroke("resume", back, top)
