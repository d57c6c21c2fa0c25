"""Tests of all pairs of policies as one family, and the ranks that follow from them.

References
----------
P. H. Westfall, S. S. Young (1993). Resampling-Based Multiple Testing. Wiley (max-T).

J. P. Romano, M. Wolf (2005). Exact and approximate stepdown methods for multiple hypothesis
testing. Journal of the American Statistical Association 100(469):94-108.
"""

import functools
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Final

import numpy as np
from colift.benchmark.statistics.permutation import ROUNDING, far_apart, sign_flips
from colift.benchmark.statistics.samples import FloatArray, paired
from colift.benchmark.statistics.units import Units
from numpy.typing import ArrayLike

LEVEL: Final = 0.04
"""Largest p value at which two policies are told apart. Skewed differences make sign flips somewhat
liberal; with this level, equal policies are told apart on at most 6 % of boards, as the command
``colift statistics`` shows."""

FLIPS: Final = 10_000
"""Sign flips of a family of few pairs."""

FEWEST_FLIPS: Final = 1_000
"""Sign flips of a family of any size."""

MOST_VALUES: Final = 2**29
"""Largest product of pairs and flips, beyond the fewest flips."""

BLOCK: Final = 256
"""Number of flips that are compared at once."""


@dataclass(frozen=True, eq=False)
class Family:
    """The tests of all pairs of k policies on the same episodes."""

    names: tuple[str, ...]
    """The policies in the order of their means, the best first; equal ones in that of names."""
    ps: FloatArray
    """p value of each pair, shape (k, k), corrected for all pairs; 1 on the diagonal."""
    level: float

    def p(self, one: str, other: str) -> float:
        """Return the p value for "these two do not differ", corrected for all pairs."""
        return float(self.ps[self._places[one], self._places[other]])

    def apart(self, one: str, other: str) -> bool:
        """Return whether two policies differ beyond chance."""
        return self.p(one, other) <= self.level

    @functools.cached_property
    def ranks(self) -> dict[str, int]:
        """The rank of each policy, in the order of their means.

        It is 1 + the number of policies that are better beyond chance, and at least the rank of any
        policy with a smaller mean: who varies so much that nobody can be told from them does not
        pass those who are better.
        """
        better = np.maximum.accumulate(np.tril(self.ps <= self.level, -1).sum(axis=1))
        return {name: 1 + int(count) for name, count in zip(self.names, better, strict=True)}

    @functools.cached_property
    def _places(self) -> dict[str, int]:
        return {name: i for i, name in enumerate(self.names)}


def decisive(people: int, *, level: float = LEVEL) -> bool:
    """Return whether this number of people can tell any two policies apart.

    Of k people there are 2^k sign flips, and the smallest two-sided p value is 2^(1 - k): all
    differences have the same sign. Five people are never enough; six are.
    """
    return 2.0 ** (1 - people) <= level


def all_pairs(
    errors: Mapping[str, ArrayLike], units: Units, *, level: float = LEVEL, seed: int = 0
) -> Family:
    r"""Return the tests of all pairs of policies: step-down max-T by joint sign flips of people.

    With the sum :math:`d_u` of the differences of a pair with person u, and signs :math:`s_u`, the
    statistic of a pair is studentised,

    .. math:: z(s) = \frac{|\sum_u s_u d_u|}{\sqrt{\sum_u d_u^2}},

    which increases with \|t\|. All pairs have the same signs, so that their dependence is kept. The
    corrected p value of a pair is the share of flips in which the largest z(s) of all pairs reaches
    the observed z. Pairs with a p value up to the level are told apart; the others are tested again
    among themselves, until no further pair is told apart. The probability that any two equal
    policies are told apart is then the level, however many others differ (Romano & Wolf 2005).

    Pairs that :func:`.far_apart` shows to be beyond every flip are not flipped: with thousands of
    policies, these are most.

    Parameters
    ----------
    errors
        Error of each policy in the same episodes in the same order, each of shape (n,); smaller is
        better. Failed episodes are included, with the worst error.
    units
        The people of these episodes.
    level
        Largest corrected p value at which two policies are told apart.
    seed
        Seed of the flips.

    Returns
    -------
    Family
        The tests; the order of ``errors`` does not matter.

    Raises
    ------
    InputError
        If values are empty, not finite or of unequal length.
    """
    names = sorted(errors)
    samples = {name: paired(names[0], errors[names[0]], name, errors[name])[1] for name in names}
    order = tuple(sorted(names, key=lambda name: float(np.mean(samples[name]))))
    if not order:
        return Family(names=(), ps=np.ones((0, 0)), level=level)
    rows = np.array([samples[name] for name in order])
    # How difficult a person is cancels; without it, the products lose no digits.
    sums = units.sums(rows - rows.mean(axis=0))
    ps = _step_down(sums, level, seed)
    return Family(names=order, ps=ps, level=level)


def _step_down(sums: FloatArray, level: float, seed: int) -> FloatArray:
    """Return the corrected p value of each two rows of ``sums``, shape (k, k)."""
    norms = np.sqrt(np.triu(_squares(sums), 1))
    scale = np.divide(1.0, norms, out=np.zeros_like(norms), where=norms > 0.0)
    total = sums.sum(axis=1)
    z = np.abs(total[:, None] - total) * scale * (1.0 - ROUNDING)
    pairs = max(1, len(sums) * (len(sums) - 1) // 2)
    signs = sign_flips(sums.shape[1], max(FEWEST_FLIPS, min(FLIPS, MOST_VALUES // pairs)), seed)
    least = 1.0 / (1.0 + len(signs))
    flipped = np.ascontiguousarray((signs @ sums.T).T)
    ps = np.where(scale > 0.0, least, 1.0)
    waiting = (scale > 0.0) & (z < far_apart(least / pairs))
    passed, lowest = waiting.any(), least
    while passed:
        largest = np.sort(_largest(flipped, np.where(waiting, scale, 0.0)))
        reached = len(signs) - np.searchsorted(largest, z[waiting])
        ps[waiting] = np.maximum(lowest, (1 + reached) * least)
        passed = waiting & (ps <= level)
        lowest = ps[passed].max(initial=lowest)
        waiting &= ~passed
        passed = passed.any() and waiting.any()
    return np.minimum(ps, ps.T)


def _largest(flipped: FloatArray, scale: FloatArray) -> FloatArray:
    """Return the largest statistic of all pairs in each flip, shape (flips,).

    Parameters
    ----------
    flipped
        Flipped sums of each policy, shape (k, flips).
    scale
        Factor of each pair's difference, shape (k, k); zero for pairs that do not count.
    """
    found = np.zeros(flipped.shape[1])
    for first in range(0, flipped.shape[1], BLOCK):
        some = flipped[:, first : first + BLOCK]
        best = found[first : first + BLOCK]
        for i, factors in enumerate(scale):
            (columns,) = factors.nonzero()
            if columns.size:
                near = slice(columns[0], columns[-1] + 1)
                values = np.abs(some[near] - some[i])
                values *= factors[near, None]
                np.maximum(best, values.max(axis=0), out=best)
    return found


def _squares(sums: FloatArray) -> FloatArray:
    """Return the sum of squared differences of each two rows, shape (k, k), rounded up."""
    own = (sums**2).sum(axis=1)
    both = own[:, None] + own[None, :]
    squares = both - 2.0 * (sums @ sums.T)
    return np.where(squares > ROUNDING * both, squares, 0.0)
