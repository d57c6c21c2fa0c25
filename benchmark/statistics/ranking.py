"""Ranks that claim no more than the episodes show: indistinguishable policies share a rank."""

from collections.abc import Mapping
from typing import Final

import numpy as np
from numpy.typing import ArrayLike

from .permutation import holm_correction, permutation_ps_against
from .samples import paired

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
        As for :func:`.paired_permutation_p`.

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
    means = {name: _mean(names[0], name, errors) for name in names}
    waiting = sorted(names, key=lambda name: means[name])
    groups = []
    while waiting:
        anchor, *behind = waiting
        ps = permutation_ps_against(
            errors[anchor], [errors[name] for name in behind], resamples=resamples, seed=seed
        )
        apart = holm_correction(ps) <= level
        size = 1 + (int(apart.argmax()) if apart.any() else len(behind))
        groups.append(tuple(waiting[:size]))
        waiting = waiting[size:]
    return tuple(groups)


def _mean(first: str, name: str, errors: Mapping[str, ArrayLike]) -> float:
    _, values = paired(first, errors[first], name, errors[name])
    return float(np.mean(values))
