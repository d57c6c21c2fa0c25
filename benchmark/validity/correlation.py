r"""Rank correlations of two orders of the same policies, for many resamples at a time.

Ties have the mean of the ranks that they share; Kendall's coefficient is :math:`\tau_b`, which
accounts for them.

References
----------
C. Spearman (1904). The proof and measurement of association between two things. The American
Journal of Psychology 15(1):72-101.

M. G. Kendall (1945). The treatment of ties in ranking problems. Biometrika 33(3):239-251.
"""

import numpy as np
from colift.benchmark.statistics import FloatArray


def average_ranks(values: FloatArray) -> FloatArray:
    """Return the rank of each value along the last axis: 1 for the smallest, ties averaged.

    Parameters
    ----------
    values
        Values, shape (..., k).
    """
    signs = _signs(values)
    k = values.shape[-1]
    # The rank of a value among k: half of (values below - values above + k + 1).
    found: FloatArray = (signs.sum(axis=-1) + k + 1) / 2.0
    return found


def spearman(a: FloatArray, b: FloatArray) -> FloatArray:
    r"""Return Spearman's rank correlation along the last axis.

    .. math:: \rho = \frac{\sum_i (r_i - \bar r)(s_i - \bar s)}
        {\sqrt{\sum_i (r_i - \bar r)^2 \, \sum_i (s_i - \bar s)^2}}

    for the :func:`average_ranks` r and s.

    Parameters
    ----------
    a, b
        Scores of the same k policies, shape (..., k).

    Returns
    -------
    array
        Correlation, -1 to 1, shape (...); 0 where all values of one side are equal, as they then
        predict no order.
    """
    r, s = average_ranks(a), average_ranks(b)
    k = a.shape[-1]
    return _ratio(r - (k + 1) / 2, s - (k + 1) / 2, axes=(-1,))


def kendall(a: FloatArray, b: FloatArray) -> FloatArray:
    r"""Return Kendall's rank correlation :math:`\tau_b` along the last axis.

    .. math:: \tau_b = \frac{C - D}{\sqrt{(C + D + T_a)(C + D + T_b)}}

    for C concordant and D discordant pairs, and the pairs :math:`T_a`, :math:`T_b` that are tied
    in b or in a only. Without ties, the share of pairs in the same order is
    :math:`(1 + \tau_b) / 2`. Arguments and result are as for :func:`spearman`.
    """
    return _ratio(_signs(a), _signs(b), axes=(-2, -1))


def _signs(values: FloatArray) -> FloatArray:
    """Return the sign of the difference of each pair of values, shape (..., k, k)."""
    return np.sign(values[..., :, None] - values[..., None, :])


def _ratio(x: FloatArray, y: FloatArray, axes: tuple[int, ...]) -> FloatArray:
    """Return the sum of products over the root of the product of the sums of squares."""
    size = np.sqrt((x * x).sum(axis=axes) * (y * y).sum(axis=axes))
    found: FloatArray = (x * y).sum(axis=axes) / np.where(size > 0.0, size, 1.0)
    return found
