"""Ranks that claim no more than the episodes show: indistinguishable policies share a rank."""

from collections.abc import Mapping
from typing import Final

import numpy as np
from colift.benchmark.statistics.permutation import (
    far_apart,
    holm_correction,
    sequential_permutation_ps,
)
from colift.benchmark.statistics.samples import FloatArray, paired
from numpy.typing import ArrayLike, NDArray

RankGroups = tuple[tuple[str, ...], ...]

LEVEL: Final = 0.05
"""Largest corrected p value at which two policies are distinguished."""


def decisive(policies: int, episodes: int, *, level: float = LEVEL) -> bool:
    """Return whether :func:`rank_groups` can separate the best from any other at all.

    Of n episodes there are 2^n sign flips, and the smallest two-sided p value is 2^(1 - n): all
    differences have the same sign. With k policies behind the best, Holm's correction multiplies
    this by k. Three episodes are never enough; six are enough for one policy behind the best.
    """
    return (policies - 1) * 2.0 ** (1 - episodes) <= level


def rank_groups(
    errors: Mapping[str, ArrayLike],
    *,
    level: float = LEVEL,
    resamples: int = 10_000,
    seed: int = 0,
) -> RankGroups:
    """Return the policies in groups, best first; those of a group share a rank.

    In the order of their means, the first policy is the anchor of the first group. Its paired
    permutation tests against all policies behind it, Holm-corrected, show which of them differ from
    it. The policies before the first that differs join its group; that policy is the next anchor,
    and so on. The anchor of a group never moves: if each were compared with its neighbour instead,
    small differences would chain, and the first and the last of a group could be far apart.

    The episodes therefore cannot distinguish any policy in a group from the group's best, and the
    anchors of two neighbouring groups are distinguishable. Two policies of one group, or of
    neighbouring groups, may still differ from each other in either direction; use
    :func:`.paired_difference` for pairs.

    Parameters
    ----------
    errors
        Error of each policy in the same episodes in the same order, each of shape (n,); smaller is
        better. Failed episodes are included, with the worst error.
    level
        Largest corrected p value at which two policies are distinguished.
    resamples, seed
        As for :func:`.paired_permutation_p`; where more than ``resamples`` / :data:`FLIPS` policies
        are tested at once, there are :data:`FLIPS` flips for each.

    Returns
    -------
    tuple of tuples of str
        Names, each group in the order of the means, its anchor first. The order of ``errors``
        does not matter; policies of equal mean are in the order of their names.

    Raises
    ------
    InputError
        If values are empty, not finite or of unequal length.
    """
    names = sorted(errors)
    samples = {name: paired(names[0], errors[names[0]], name, errors[name])[1] for name in names}
    order = sorted(names, key=lambda name: float(np.mean(samples[name])))
    if not names:
        return ()
    rows = np.array([samples[name] for name in order])
    spread, groups, first = _Spread(rows), [], 0
    while first < len(order):
        size = 1 + _sharing(rows, first, spread.behind(first), level, resamples, seed)
        groups.append(tuple(order[first : first + size]))
        first += size
    return tuple(groups)


FLIPS: Final = 40
"""Sign flips for each test. Corrected for n tests (Holm), the smallest p value that m flips can
give is n / (m + 1). With m = 40 n that is half of the level; with fewer than 20 n flips, no two
policies could be distinguished."""


def _sharing(
    rows: FloatArray, first: int, z2: FloatArray, level: float, resamples: int, seed: int
) -> int:
    """Return the number of rows behind an anchor that share its group.

    Most policies are so far behind that a bound of the p value rejects them; the others are tested.
    This is Holm's procedure over all of them.
    """
    apart = _surely_apart(z2, level)
    near = np.flatnonzero(~apart)
    if near.size:
        differences = rows[first] - rows[first + 1 + near]
        ps = sequential_permutation_ps(
            differences, resamples=max(resamples, FLIPS * near.size), seed=seed
        )
        apart[near] = holm_correction(ps) <= level
    return int(apart.argmax()) if apart.any() else len(apart)


def _surely_apart(z2: FloatArray, level: float) -> NDArray[np.bool_]:
    """Return which tests :func:`.far_apart` rejects, step by step as in Holm's procedure.

    ``z2`` has the squared deviates of the tests, shape (m,).
    """
    left = len(z2)
    apart = np.zeros(left, dtype=np.bool_)
    while left:
        apart = z2 >= far_apart(level / left) ** 2
        if len(z2) - int(apart.sum()) == left:
            break
        left = len(z2) - int(apart.sum())
    return apart


class _Spread:
    """Squared deviates of paired differences, for blocks of anchors at a time.

    The deviate of a row from an anchor is the sum of their differences over the root of the sum of
    their squares. It is rounded down, never up.
    """

    def __init__(self, rows: FloatArray) -> None:
        # How difficult a lift is cancels; without it, the products lose no digits.
        self._rows = rows - rows.mean(axis=0)
        self._sums = self._rows.sum(axis=1)
        self._squares = (self._rows**2).sum(axis=1)
        self._first, self._products = 0, np.empty((0, 0))

    def behind(self, anchor: int) -> FloatArray:
        """Return the squared deviates of the rows behind one, shape (m,)."""
        if not self._first <= anchor < self._first + len(self._products):
            self._first = anchor
            self._products = self._rows[anchor : anchor + ANCHORS] @ self._rows[anchor:].T
        products = self._products[anchor - self._first, anchor + 1 - self._first :]
        both = self._squares[anchor] + self._squares[anchor + 1 :]
        squares = both - 2.0 * products + ROUNDING * both
        total = self._sums[anchor + 1 :] - self._sums[anchor]
        z2: FloatArray = np.divide(total**2, squares, out=np.zeros_like(total), where=squares > 0.0)
        return z2


ANCHORS: Final = 128
"""Number of anchors whose products with all rows are made at once."""

ROUNDING: Final = 1e-9
"""Bound of the relative rounding error of those."""
