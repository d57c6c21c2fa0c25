"""The goal of a partner: a Bayes filter over heights on a grid."""

import math
from dataclasses import dataclass
from typing import Final

GOALS: Final = (-0.06, -0.05, -0.04, -0.03, -0.02, 0.0, 0.02, 0.03, 0.04, 0.05, 0.06)
"""The goals, above the common height [m]: the common height itself, and where hurdles may be."""

FARTHEST: Final = 200.0
"""Largest square of a deviation, in standard deviations, that counts."""


@dataclass(frozen=True, kw_only=True)
class BeliefParameters:
    """Parameters of :class:`GoalBelief`."""

    pace: float = 5.0
    """Rate at which a partner approaches its goal [1/s]."""
    noise: float = 0.04
    """Standard deviation of a partner's speed about that of the approach [m/s]."""
    change: float = 0.08
    """Probability that a partner changes its mind in 0.1 s."""
    along: float = 0.8
    """Probability that a partner who has changed its mind comes along, with no goal of its own."""


class GoalBelief:
    r"""The probabilities of a partner's goals, updated by its motion.

    A partner either comes along, towards the height m of the observer, or goes to a height h_k of
    its own. At the height z it is expected to move, in the time dt, by

        (1 - exp(-pace dt)) (goal - z),

    with normal deviations. Between two updates it may change its mind: a hidden Markov model with
    one state for each goal.
    """

    def __init__(self, parameters: BeliefParameters | None = None) -> None:
        self._parameters = parameters or BeliefParameters()
        self.forget()

    def forget(self) -> None:
        """Return to the prior."""
        along = self._parameters.along
        self._prior = [along] + [(1 - along) / len(GOALS)] * len(GOALS)
        self._chances = list(self._prior)

    def update(
        self, before: float, after: float, mine: float, common: float, time: float, noise: float = 0
    ) -> None:
        """Update by a motion of the partner from one height to another [m] within ``time`` [s].

        Parameters
        ----------
        before, after
            The partner's heights [m].
        mine
            The observer's own height then [m].
        common
            The common height, in the middle of the grid [m].
        time
            [s]
        noise
            Standard deviation of the speed's measurement [m/s].
        """
        parameters = self._parameters
        moved = -math.expm1(-parameters.pace * time)
        spread = math.hypot(parameters.noise, noise) * time
        goals = [mine, *(common + offset for offset in GOALS)]
        change = 1 - (1 - parameters.change) ** (time / 0.1)
        deviations = [(after - before - moved * (goal - before)) / spread for goal in goals]
        squares = [min(each * each, FARTHEST) for each in deviations]
        nearest = min(squares)  # The likeliest goal has the weight 1: the sum is never 0.
        weighed = [
            ((1 - change) * chance + change * prior) * math.exp(-0.5 * (square - nearest))
            for chance, prior, square in zip(self._chances, self._prior, squares, strict=True)
        ]
        total = math.fsum(weighed)
        self._chances = [weight / total for weight in weighed]

    @property
    def own_goal(self) -> float:
        """Probability that the partner goes to a height of its own, away from the common one."""
        return 1.0 - self._chances[0] - self._chances[1 + GOALS.index(0.0)]

    @property
    def offset(self) -> float:
        """Expected offset of the partner's goal from the common height [m]; 0 if it has none."""
        pairs = zip(self._chances[1:], GOALS, strict=True)
        return math.fsum(chance * offset for chance, offset in pairs)
