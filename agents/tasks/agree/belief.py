"""The goal of a partner: a Bayes filter over heights on a grid."""

import math
from dataclasses import dataclass
from typing import Any, Final, Generic, NamedTuple

from colift.agents.ranges import Positive, Probability, check_ranges
from colift.agents.rules import SCALARS, ArrayFunctions, N

GOALS: Final = (-0.06, -0.05, -0.04, -0.03, -0.02, 0.0, 0.02, 0.03, 0.04, 0.05, 0.06)
"""The goals, above the common height [m]: the common height itself, and where hurdles may be."""

FARTHEST: Final = 200.0
"""Largest square of a deviation, in standard deviations, that counts."""


@dataclass(frozen=True, kw_only=True)
class BeliefParameters:
    """Parameters of :func:`believe`."""

    pace: Positive = 5.0
    """Rate at which a partner approaches its goal [1/s]."""
    noise: Positive = 0.04
    """Standard deviation of a partner's speed about that of the approach [m/s]."""
    change: Probability = 0.08
    """Probability that a partner changes its mind in 0.1 s."""
    along: Probability = 0.8
    """Probability that a partner who has changed its mind comes along, with no goal of its own."""

    def __post_init__(self) -> None:
        """Check the ranges; see :mod:`colift.agents.ranges`."""
        check_ranges(self)


MIDDLE: Final = 1 + GOALS.index(0.0)
"""Index of the common height in a row of chances."""


def prior(f: ArrayFunctions[N], parameters: BeliefParameters, like: N) -> Any:
    """Return the row of chances of a partner of whom nothing is known: see :func:`believe`."""
    along = parameters.along
    return f.row([along] + [(1 - along) / len(GOALS)] * len(GOALS), like)


class Motion(NamedTuple, Generic[N]):
    """A seen motion of the partner."""

    before: N
    """Height of the partner at its beginning [m]."""
    after: N
    """Height of the partner at its end [m]."""
    mine: N
    """The observer's own height then [m]."""
    common: N
    """The common height, in the middle of the grid [m]."""
    noise: N
    """Standard deviation of the measurement of its speed [m/s]."""


def believe(
    f: ArrayFunctions[N],
    parameters: BeliefParameters,
    chances: Any,
    seen: Motion[N],
    time: float,
) -> Any:
    """Return the chances of a partner's goals after a motion within ``time`` [s].

    A row of chances has first the one that the partner comes along, towards the height of the
    observer, then those that it goes to each of :data:`GOALS`. At the height z it is expected to
    move, in the time dt, by

        (1 - exp(-pace dt)) (goal - z),

    with normal deviations. Between two motions it may change its mind: a hidden Markov model with
    one state for each goal.
    """
    moved = -math.expm1(-parameters.pace * time)
    spread = f.hypot(parameters.noise, seen.noise) * time
    change = 1 - (1 - parameters.change) ** (time / 0.1)

    def square(goal: N) -> N:
        deviation = (seen.after - seen.before - moved * (goal - seen.before)) / spread
        return f.minimum(deviation * deviation, FARTHEST)

    goals: list[N] = [seen.mine]
    goals += [seen.common + offset for offset in GOALS]
    squares = f.each(square, f.row(goals, seen.mine))
    nearest = f.fixed(f.least(squares))  # The likeliest goal has the weight 1: the sum is never 0.

    def weight(chance: N, before: N, square: N) -> N:
        kept: N = (1 - change) * chance + change * before
        return f.exp((square - nearest) * -0.5) * kept

    weighed = f.each(weight, chances, prior(f, parameters, seen.mine), squares)
    total = f.total(weighed)
    return f.each(lambda each: each / total, weighed)


def own_goal(chances: Any) -> Any:
    """Return the chance that the partner goes to a height away from the common one."""
    return 1.0 - chances[0] - chances[MIDDLE]


def expected_offset(f: ArrayFunctions[N], chances: Any) -> N:
    """Return the expected offset of the partner's goal from the common height [m]; 0 if none."""
    offsets = f.row(GOALS, chances[0])
    return f.total(f.each(lambda chance, offset: chance * offset, chances[1:], offsets))


class GoalBelief:
    """The chances of a partner's goals in one lift; see :func:`believe`."""

    def __init__(self, parameters: BeliefParameters | None = None) -> None:
        self._parameters = parameters or BeliefParameters()
        self.forget()

    def forget(self) -> None:
        """Return to the prior."""
        self._chances = prior(SCALARS, self._parameters, 0.0)

    def update(self, before: float, after: float, mine: float, common: float, time: float) -> None:
        """Update by a motion of the partner from one height to another [m] within ``time`` [s].

        ``mine`` is the observer's own height, ``common`` the common one [m].
        """
        motion = Motion(before, after, mine, common, 0.0)
        self._chances = believe(SCALARS, self._parameters, self._chances, motion, time)

    @property
    def own_goal(self) -> float:
        """Probability that the partner goes to a height of its own, away from the common one."""
        return float(own_goal(self._chances))

    @property
    def offset(self) -> float:
        """Expected offset of the partner's goal from the common height [m]; 0 if it has none."""
        return expected_offset(SCALARS, self._chances)
