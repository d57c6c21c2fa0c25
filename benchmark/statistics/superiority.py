"""The probability that one policy is better than another, and the share of episodes in which it is.

Better means smaller: the values are errors.

References
----------
R. Agarwal et al. (2021). Deep reinforcement learning at the edge of the statistical precipice.
NeurIPS 34 (probability of improvement).
"""

import numpy as np
from colift.benchmark.statistics.samples import paired
from colift.benchmark.statistics.student import t_cdf
from colift.benchmark.statistics.units import Units
from numpy.typing import ArrayLike


def probability_better(a: ArrayLike, b: ArrayLike, units: Units) -> float | None:
    r"""Return the probability that the mean of a is below that of b with other such people.

    With the mean difference :math:`\bar d` and its standard error :math:`s` between k people in c
    groups,

    .. math:: P = F_{k - c}(-\bar d / s)

    of the distribution function F of Student's t. It is above 0.975 if the 95 % interval of
    :func:`.paired_difference` lies below zero. If the true means are equal, P is uniform between 0
    and 1.

    Parameters
    ----------
    a, b
        Errors of two policies on the same episodes in the same order, each of shape (n,).
    units
        The people of these episodes.

    Returns
    -------
    float or None
        Probability, 0 to 1; 0.5 if all values are equal; None if all episodes are of one person.

    Raises
    ------
    InputError
        If the values are empty, not finite or of unequal length.
    """
    x, y = paired("a", a, "b", b)
    left = x - y
    mean, error = float(left.mean()), units.standard_error(left)
    if error is None:
        return None
    if error <= 1e-12 * float(np.abs(left).max()):
        return 0.5 if mean == 0.0 else float(mean < 0.0)
    return t_cdf(-mean / error, units.freedom)


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
