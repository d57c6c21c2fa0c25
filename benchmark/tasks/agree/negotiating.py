"""Negotiation of a person with a hurdle: belief, turn, and the best response to the far end."""

import math
from typing import Any, Final, Generic, NamedTuple

from colift.agents.agent import FRAME
from colift.agents.rules import ArrayFunctions, N
from colift.agents.tasks.agree.belief import (
    BeliefParameters,
    Motion,
    believe,
    expected_offset,
    own_goal,
    prior,
)
from colift.benchmark.tasks.agree.manner import AgreeingManner
from colift.benchmark.tasks.agree.precedence import Secret, Sight, Turn, mine, served

PACE: Final = 8.0
"""omega, the natural frequency of a person's approach [rad/s]: a hurdle 50 mm away is passed after
some 0.4 s."""

RESTING: Final = 0.02
"""Speed of the common way below which it rests [m/s]."""

LIFTED: Final = 0.08
"""Height above which a rest is the common height [m]."""

APART: Final = 0.5
"""Probability from which the partner counts as going to a goal of its own."""

_BELIEF: Final = BeliefParameters()


class Agreeing(NamedTuple, Generic[N]):
    """What a person keeps from step to step."""

    chances: Any
    """The row of chances of the partner's goals; see :func:`.believe`."""
    far: N
    """The far end as last seen [m]."""
    common: N
    """The common height while the common way rests there [m], else 0."""
    turn: Turn[N]
    """Whose turn it is."""


class AgreeingSenses(NamedTuple, Generic[N]):
    """What a person perceives."""

    own: N
    """Height of the person's end now [m]."""
    then: N
    """Height of the person's end one visual delay ago [m]."""
    far: N
    """Height of the far end one visual delay ago [m]."""
    sight: N
    """Error of the far end's speed as it is seen [m/s]."""
    uncertainty: N
    """Standard deviation of that error [m/s]."""


def beginning(f: ArrayFunctions[N], zero: N, no: Any) -> Agreeing[N]:
    """Return the memory at the beginning of a lift, of a number 0 and a truth False."""
    turn = Turn(zero, zero, zero, no, no, no, no)
    return Agreeing(prior(f, _BELIEF, zero), zero, zero, turn)


def rests(f: ArrayFunctions[N], first: N, last: N, frames: int) -> Any:
    """Return whether the common way rests above the ground in a step of ``frames`` frames.

    ``first`` and ``last`` are its heights at the ends of the first and the last frame [m].
    """
    still = f.abs(last - first) < RESTING * frames * FRAME
    return f.logical_and(still, first > LIFTED)


def common_height(f: ArrayFunctions[N], before: N, resting: Any, height: N) -> N:
    """Return the common height: that of the way in the first step of its rest, else 0 [m]."""
    kept = f.where(before > 0.0, before, height)
    return f.where(resting, kept, 0.0)


def negotiate(
    f: ArrayFunctions[N],
    manner: AgreeingManner[N],
    memory: Agreeing[N],
    senses: AgreeingSenses[N],
    hurdle: Secret[N],
    resting: Any,
    height: N,
    period: float,
) -> tuple[Agreeing[N], Any]:
    """Return the memory after a step of ``period`` [s], and whether it is the person's turn.

    While the common way rests, at the common ``height`` [m], the person infers the partner's goal
    from the seen far end, and the turn follows (:func:`.mine`).
    """
    common = common_height(f, memory.common, resting, height)
    seen = Motion(
        before=memory.far,
        after=senses.far + senses.sight * period,
        mine=senses.then,
        common=common,
        noise=senses.uncertainty,
    )
    inferred = believe(f, _BELIEF, memory.chances, seen, period)
    nothing = prior(f, _BELIEF, senses.own)
    chances = f.each(lambda new, old: f.where(resting, new, old), inferred, nothing)
    sight = Sight(senses.own, senses.far, common, f.abs(senses.far - memory.far) / period)
    after = served(f, memory.turn, sight, period)
    apart = own_goal(chances) > APART
    after, goes = mine(f, manner, after, hurdle, sight, apart, period)
    turn = Turn(*(f.where(resting, new, old) for new, old in zip(after, memory.turn, strict=True)))
    return Agreeing(chances, senses.far, common, turn), f.logical_and(resting, goes)


def response(
    f: ArrayFunctions[N],
    manner: AgreeingManner[N],
    memory: Agreeing[N],
    hurdle: Secret[N],
    goes: Any,
) -> N:
    """Return the height to go to at the common height [m].

    In the person's turn the goal is the height of the own hurdle; otherwise it is the common height
    plus ``trust`` times the partner's expected offset from it. With the stiffness s, the best
    response to a far end at z is

        s goal + (1 - s) z,

    the minimum of s (x - goal)^2 + (1 - s) (x - z)^2.
    """
    along = memory.common + manner.trust * expected_offset(f, memory.chances)
    goal = f.where(goes, hurdle.height, along)
    return manner.stiffness * goal + (1 - manner.stiffness) * memory.far


class Detour(NamedTuple, Generic[N]):
    """The hand's distance from the common way; both 0 at the beginning."""

    offset: N
    """[m]"""
    rate: N
    """Its rate of change [m/s]."""


def approach(f: ArrayFunctions[N], detour: Detour[N], aim: N, base: Any) -> tuple[Detour[N], Any]:
    """Return the detour after a step, and the hand's intended height in each of its frames [m].

    The offset d from the ``base``, a height for each frame [m], approaches the ``aim`` [m] by the
    linear-quadratic regulator of a double integrator,

        d'' = omega^2 (aim - d) - sqrt(2) omega d'.
    """
    damping = math.sqrt(2.0) * PACE

    def frame(detour: Detour[N], due: tuple[Any, ...]) -> tuple[Detour[N], N]:
        offset, rate = detour
        rate = rate + (PACE * PACE * (aim - offset) - damping * rate) * FRAME
        offset = offset + rate * FRAME
        return Detour(offset, rate), due[0] + offset

    return f.frames(frame, detour, (base,))
