"""The probability that one policy is better than another, and the share of episodes in which it is.

Better means smaller: the values are errors.

References
----------
B. Efron, R. J. Tibshirani (1998). The problem of regions. The Annals of Statistics
26(5):1687-1718 (the share of a bootstrap as a confidence level).

R. Agarwal et al. (2021). Deep reinforcement learning at the edge of the statistical precipice.
NeurIPS 34 (probability of improvement).
"""

from collections.abc import Hashable, Iterable
from statistics import NormalDist
from typing import Final

import numpy as np
from colift.benchmark.statistics.samples import Members, expanded, members_of, paired, resampled
from numpy.typing import ArrayLike

DEVIATES: Final = np.linspace(-8.0, 8.0, 3201)
"""Normal deviates between which :func:`.expanded` is inverted; 8 lies beyond any resampling."""


def probability_better(
    a: ArrayLike,
    b: ArrayLike,
    strata: Iterable[Hashable],
    *,
    resamples: int = 2000,
    seed: int = 0,
) -> float:
    r"""Return the probability that the mean of a is below that of b on such episodes.

    It is the share of resamples in which the mean of the paired differences a - b is negative, ties
    counted half, with the small-sample expansion of :func:`.stratified_bootstrap` undone:

    .. math:: P = \Phi(z), \quad \sqrt{\tfrac{n}{n - c}} \; t_{\Phi(z), \, n - c}
        = \Phi^{-1}\left(\frac{\#\{\bar d^* < 0\} + \tfrac12 \#\{\bar d^* = 0\} + \tfrac12}
        {\text{resamples} + 1}\right)

    It is therefore above 0.975 if the 95 % interval of :func:`.paired_difference` lies below zero.
    If the true means are equal, P is uniform between 0 and 1. For strata of one episode it is
    meaningless, like the interval.

    Parameters
    ----------
    a, b
        Errors of two policies on the same episodes in the same order, each of shape (n,).
    strata, resamples, seed
        As for :func:`.stratified_bootstrap`.

    Returns
    -------
    float
        Probability, above 0 and below 1; 0.5 if all values are equal.

    Raises
    ------
    InputError
        If the values are empty, not finite or of unequal length.
    """
    x, y = paired("a", a, "b", b)
    members = members_of(strata, x.size)
    left = x - y
    means = resampled(lambda drawn: left[drawn].mean(axis=-1), members, resamples, seed)
    below = float((means < 0.0).sum() + 0.5 * (means == 0.0).sum())
    return NormalDist().cdf(
        _unexpanded(NormalDist().inv_cdf((below + 0.5) / (resamples + 1)), members)
    )


def _unexpanded(z: float, members: Members) -> float:
    return float(np.interp(z, expanded(DEVIATES, members), DEVIATES))


def share_better(a: ArrayLike, b: ArrayLike) -> float:
    """Return the share of the episodes in which a is below b, ties counted half.

    This is the probability of improvement of Agarwal et al. (2021) for pairs; it ignores the size
    of differences.

    Parameters
    ----------
    a, b
        Errors of two policies on the same episodes in the same order, each of shape (n,).

    Returns
    -------
    float
        Share, 0 to 1.

    Raises
    ------
    InputError
        If the values are empty, not finite or of unequal length.
    """
    x, y = paired("a", a, "b", b)
    return float(((x < y) + 0.5 * (x == y)).mean())
