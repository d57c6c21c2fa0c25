"""Correction of p values for the number of questions asked.

References
----------
S. Holm (1979). A simple sequentially rejective multiple test procedure. Scandinavian Journal of
Statistics 6(2):65-70.
"""

import numpy as np
from numpy.typing import ArrayLike

from ...agents.errors import InputError
from .samples import FloatArray


def holm_correction(ps: ArrayLike) -> FloatArray:
    r"""Return p values corrected for their number, by Holm's step-down procedure.

    With the m p values in increasing order,

    .. math:: \tilde p_{(i)} = \min\left(1, \max_{j \le i} \, (m - j + 1) \, p_{(j)}\right)

    Calling those different whose corrected p value is at most 0.05 goes wrong anywhere among the
    m in at most 5 % of the cases, however the tests depend on each other.

    Parameters
    ----------
    ps
        p values, shape (m,); m may be zero.

    Returns
    -------
    array
        Corrected p values in the order given, shape (m,): none below its own, none above 1.

    Raises
    ------
    InputError
        If one is not a number from 0 to 1.
    """
    p = np.asarray(ps, dtype=np.float64)
    outside = ~((p >= 0.0) & (p <= 1.0))
    if p.ndim != 1 or outside.any():
        told = f"shape {p.shape}" if p.ndim != 1 else f"{p[outside][0]}"
        raise InputError(f"p values must be a list of numbers from 0 to 1, got {told}")
    order = p.argsort(kind="stable")
    scaled = p[order] * np.arange(p.size, 0, -1)
    corrected = np.empty_like(p)
    corrected[order] = np.minimum(1.0, np.maximum.accumulate(scaled))
    return corrected
