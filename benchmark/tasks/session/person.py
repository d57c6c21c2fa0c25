"""The person who goes along a plan, and helps a partner as far as the partner is known."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any, ClassVar, Final, Generic, NamedTuple

from colift.agents.agent import FRAME
from colift.agents.humans import Subject
from colift.agents.humans.following import FollowsPlan
from colift.agents.humans.person import Trait, drawn_traits
from colift.agents.rules import ArrayFunctions, Drawn, N, View, at_time
from colift.benchmark.tasks.robust.patient import Paced
from colift.benchmark.tasks.session.acquaintance import STRANGER, Acquaintance

HELPS: Final[Mapping[str, Trait]] = {
    "patience": Trait(0.02, 0.06),
    "attention": Trait(0.05, 0.3),
    "care": Trait(0.4, 1.2),
}
"""Ranges of the population, uniform and independent (assumed); see :class:`HelpingManner`."""

SLOWEST: Final = 0.4
"""Slowest pace of a person who is surprised, relative to the plan's (assumed)."""

STILL: Final = 1e-4
"""Height difference in a step below which the plan rests [m]."""

SPAN: Final = 5
"""Frames over which a person sees a speed."""

_SALT: Final = 0x5E55


class HelpingManner(NamedTuple, Generic[N]):
    """The manner of a person in one lift: the person's own, and what the person has learned."""

    patience: N
    """Unexpected height difference of the ends [m] beyond which the person slows down."""
    attention: N
    """Time constant with which the person notices a height difference [s]."""
    care: N
    """Expected lag for which a person who trusts the partner goes at half of the pace [s]."""
    lag: N
    """The expected lag of the partner [s]."""
    trust: N
    """Confidence that the partner does what is expected, from 0 to 1."""


class HelpingMemory(NamedTuple, Generic[N]):
    """What a person keeps from step to step; both 0 at the beginning."""

    time: N
    """Time within the plan, in frames."""
    surprise: N
    """The unexpected height difference of which the person is aware [m]."""


def helping_pace(f: ArrayFunctions[N], manner: HelpingManner[N], surprise: N) -> N:
    """Return the pace of a person, relative to the plan's.

    With the expected lag L, the trust T and the surprise s, it is

        1 / (1 + T max(L, 0) / care) * min(max(2 - T |s| / patience, SLOWEST), 1):

    a person who expects to wait for the partner goes slowly from the beginning, and one whom the
    partner surprises goes slowly until that is over. Whoever does not trust the partner goes along
    the plan.
    """
    expecting = 1.0 / (1.0 + manner.trust * f.clip(manner.lag, 0.0, 1.0) / manner.care)
    surprised = f.clip(2.0 - manner.trust * f.abs(surprise) / manner.patience, SLOWEST, 1.0)
    return expecting * surprised


@dataclass(frozen=True, kw_only=True)
class Helps(FollowsPlan):
    """A :class:`.Person` who goes more slowly for a partner who is late (:func:`helping_pace`).

    The person sees the height difference of the ends one visual delay late, expects the own speed
    there times the expected lag, and becomes aware of the rest, the surprise, with the time
    constant of the attention. Rests are as long as planned.
    """

    known: Acquaintance[float] = STRANGER
    """What the person has learned about the partner before this lift."""
    traits: ClassVar[Mapping[str, Trait]] = HELPS
    intention: ClassVar[Any] = Paced

    def draw(
        self, subject: Subject, seed: Callable[[str], int], steps: int, size: int
    ) -> tuple[tuple[()], HelpingManner[float]]:
        """Return the person's manner."""
        own = drawn_traits(HELPS, subject, _SALT)
        return (), HelpingManner(**own, lag=self.known.lag, trust=self.known.trust)

    def begin(self, f: ArrayFunctions[N], zero: N, no: Any) -> HelpingMemory[N]:
        """Return the memory at the beginning."""
        return HelpingMemory(zero, zero)

    def intend(
        self, f: ArrayFunctions[N], drawn: Drawn[N], memory: Any, view: View[N], frames: int
    ) -> tuple[Any, Any]:
        """Return the planned heights at the person's times within the plan."""
        manner, late = drawn.manner, view.visual
        there = view.seen("target", late)
        speed = (view.seen("target", late - SPAN) - there) / (SPAN * FRAME)
        unexpected = there - view.seen("robot_end", late) - manner.lag * speed
        noticed = 1.0 - f.exp(-frames * FRAME / manner.attention)
        surprise = memory.surprise + noticed * (unexpected - memory.surprise)
        target, time = drawn.target, memory.time
        coming = at_time(f, target, time + frames) - at_time(f, target, time)
        pace = f.where(f.abs(coming) > STILL, helping_pace(f, manner, surprise), 1.0)
        times = [time + pace * (i + 1) for i in range(frames)]
        along = f.along(lambda time: Paced(at_time(f, target, time), time), f.column(times))
        return HelpingMemory(times[-1], surprise), along
