"""Student's t distribution, exact for whole degrees of freedom.

References
----------
M. Abramowitz, I. A. Stegun (1964). Handbook of Mathematical Functions, 26.7.3 and 26.7.4.
"""

import functools
import math
from typing import Final

LARGEST: Final = 2.0**60
"""Quantiles are searched up to this value."""


def t_cdf(t: float, freedom: int) -> float:
    r"""Return the probability that Student's t is at most ``t``.

    With :math:`\theta = \arctan(t / \sqrt{\nu})`, the probability of a value between -t and t is a
    finite series in :math:`\cos^2 \theta`, one for odd and one for even degrees of freedom
    :math:`\nu \ge 1`.
    """
    theta = math.atan2(t, math.sqrt(freedom))
    cos2 = freedom / (freedom + t * t)
    odd = freedom % 2
    term, total = (math.cos(theta) if odd else 1.0), 0.0
    for i in range(freedom // 2):
        total += term
        term *= cos2 * (2 * i + 1 + odd) / (2 * i + 2 + odd)
    inside = total * math.sin(theta)
    if odd:
        inside = 2.0 / math.pi * (theta + inside)
    return min(max(0.5 + 0.5 * inside, 0.0), 1.0)  # The series is rounded.


@functools.lru_cache(maxsize=1024)
def t_quantile(p: float, freedom: int) -> float:
    """Return the value that Student's t exceeds with probability 1 - p, for 0 < p < 1."""
    if p < 0.5:
        return -t_quantile(1.0 - p, freedom)
    low, high = 0.0, 1.0
    while t_cdf(high, freedom) < p and high < LARGEST:
        low, high = high, 2.0 * high
    for _ in range(100):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if t_cdf(middle, freedom) < p else (low, middle)
    return 0.5 * (low + high)
