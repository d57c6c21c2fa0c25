"""Student's t distribution, for intervals and tests from few people."""

import math
from functools import cache
from typing import Final

from colift.base.errors import InputError

TINY: Final = 1e-300
"""Smallest denominator of the continued fraction."""

TERMS: Final = 400
"""Most terms of it; some dozens are enough."""


def survival(t: float, dof: float) -> float:
    r"""Return the probability that Student's t exceeds ``t``.

    .. math:: P(T > t) = \tfrac12 I_x(\nu / 2, 1 / 2), \quad x = \nu / (\nu + t^2), \quad t \ge 0

    Raises
    ------
    InputError
        If there is no positive number of degrees of freedom.
    """
    if not dof > 0:
        raise InputError(f"degrees of freedom must be positive, got {dof}")
    half = 0.5 * _beta_share(dof / (dof + t * t), dof / 2, 0.5)
    return half if t >= 0 else 1.0 - half


@cache
def quantile(tail: float, dof: float) -> float:
    """Return the t that Student's t exceeds with the probability ``tail``, of at most 0.5.

    Raises
    ------
    InputError
        If the probability is not in (0, 0.5], or as :func:`survival`.
    """
    if not 0 < tail <= 0.5:
        raise InputError(f"the tail must be above 0 and at most 0.5, got {tail}")
    low, high = 0.0, 1.0
    while survival(high, dof) > tail:
        high *= 2
    for _ in range(60):
        middle = (low + high) / 2
        low, high = (middle, high) if survival(middle, dof) > tail else (low, middle)
    return (low + high) / 2


def _beta_share(x: float, a: float, b: float) -> float:
    """Return the regularised incomplete beta function (Abramowitz & Stegun 26.5.8)."""
    if x <= 0.0 or x >= 1.0:
        return min(max(x, 0.0), 1.0)
    if x > (a + 1) / (a + b + 2):
        return 1.0 - _beta_share(1.0 - x, b, a)
    scale = math.lgamma(a + b) - math.lgamma(a) - math.lgamma(b)
    front = math.exp(scale + a * math.log(x) + b * math.log1p(-x)) / a
    c, d = 1.0, 1.0 / _away(1.0 - (a + b) * x / (a + 1))
    fraction = d
    for m in range(1, TERMS):
        for factor in (
            m * (b - m) * x / ((a + 2 * m - 1) * (a + 2 * m)),
            -(a + m) * (a + b + m) * x / ((a + 2 * m) * (a + 2 * m + 1)),
        ):
            c, d = _away(1.0 + factor / c), 1.0 / _away(1.0 + factor * d)
            fraction *= c * d
        if abs(c * d - 1.0) < 1e-15:
            break
    return front * fraction


def _away(value: float) -> float:
    """Return a number that can be divided by."""
    return value if abs(value) > TINY else TINY
