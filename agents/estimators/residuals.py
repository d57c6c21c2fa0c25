"""Confidence in a prediction from the statistics of its residuals.

The paper derives its confidence (eqs. 6 and 7) from an earlier one "based on the statistical
properties of the residuals between the predicted measurements and the observed measurements"
(section III.B, its reference 13). This module implements one such confidence: the standard test of
a Kalman filter's consistency by its time-average normalised innovation squared (Bar-Shalom, Li,
Kirubarajan, *Estimation with Applications to Tracking and Navigation*, 2001, section 5.4), with the
test's p-value as the confidence.
"""

import math
from collections import deque

from colift.base.errors import InputError

LONGEST = 100
"""Largest number of residuals in a window."""


def chi_square_tail(value: float, degrees: int) -> float:
    """Return the probability that a chi-square variable exceeds ``value``, in [0, 1].

        Q_1(x) = erfc(sqrt(x / 2)),  Q_2(x) = exp(-x / 2),
        Q_(n+2)(x) = Q_n(x) + (x / 2)^(n / 2) exp(-x / 2) / Gamma(n / 2 + 1)

    (Abramowitz and Stegun, *Handbook of Mathematical Functions*, 26.4.4, 26.4.5 and 26.4.8.)

    Parameters
    ----------
    value
        x, at least 0.
    degrees
        Degrees of freedom n, from 1 to :data:`LONGEST`; far beyond, the terms would underflow.
    """
    half = value / 2
    if degrees % 2:
        tail = math.erfc(math.sqrt(half))
        term = math.sqrt(half) * math.exp(-half) / math.gamma(1.5)
    else:
        tail = math.exp(-half)
        term = half * tail
    for n in range(2 - degrees % 2, degrees, 2):
        tail += term
        term *= half / (n / 2 + 1)
    return min(tail, 1.0)


class ResidualConfidence:
    """The p-value of the latest residuals under the filter's model.

    Normalised innovations v^2 / S of a consistent filter are chi-square with one degree of
    freedom and independent; their sum over a window of n has n degrees of freedom:

        C = P(chi2_n >= v_1^2 / S_1 + ... + v_n^2 / S_n)

    It is near 1 while the errors are smaller than the filter expects, uniform in [0, 1] for a
    consistent filter, and near 0 when the motion does not follow the model. Until the window is
    full, n is the number of residuals so far; with none, C = 1.

    Parameters
    ----------
    window
        Number of residuals tested together, from 1 to :data:`LONGEST`: more reject a wrong model
        with greater power, fewer forget it sooner.

    Raises
    ------
    InputError
        If the window is out of range.
    """

    def __init__(self, window: int = 5) -> None:
        if not 1 <= window <= LONGEST:
            raise InputError(f"window must be from 1 to {LONGEST} residuals, got {window}")
        self._squares: deque[float] = deque(maxlen=window)

    def update(self, innovation: float, variance: float) -> float:
        """Add the newest residual and return the confidence.

        Parameters
        ----------
        innovation
            v, measured minus predicted height [mm].
        variance
            S, its variance by the filter: that of the prediction plus R [mm2], positive.
        """
        self._squares.append(innovation**2 / variance)
        return chi_square_tail(math.fsum(self._squares), len(self._squares))
