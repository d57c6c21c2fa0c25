"""The paper's confidence in a prediction (equations 6 and 7)."""

import math
from typing import Literal

from colift.base.errors import InputError

Reading = Literal["variance as rho", "standard deviation as rho"]
"""Reading of eq. 6. The paper calls rho "the 1-D variance" and squares it: literally the
variance [mm2] stands where a Gaussian has its standard deviation. The other reading takes the
root of the variance."""

LITERAL: Reading = "variance as rho"


def likelihood(error: float, variance: float, reading: Reading = LITERAL) -> float:
    """Return the unnormalised likelihood of a measurement (eq. 6), in (0, 1].

    Beyond 38 rho it underflows to 0.

        L = exp(-(z - s)^2 / (2 rho^2))

    Parameters
    ----------
    error
        Measured minus predicted height, z - s [mm].
    variance
        Variance of the predicted height [mm2], positive.
    reading
        Meaning of rho.
    """
    rho = variance if reading == LITERAL else math.sqrt(variance)
    return math.exp(-0.5 * (error / rho) ** 2)


class Confidence:
    """The forgetting mean of all likelihoods so far (eq. 7), computed recursively.

        C_(k+1) = (L_k + phi L_(k-1) + ... + phi^(k-1) L_1) / (1 + phi + ... + phi^(k-1))

    Parameters
    ----------
    forgetting
        phi, in (0, 1]: a small value forgets fast. The paper found 0.45 good (section IV.C).

    Raises
    ------
    InputError
        If phi is not in (0, 1].
    """

    def __init__(self, forgetting: float = 0.45) -> None:
        if not 0 < forgetting <= 1:
            raise InputError(f"forgetting must be in (0, 1], got {forgetting}")
        self._forgetting = forgetting
        self._sum = self._weight = 0.0

    def update(self, likelihood: float) -> float:
        """Add the newest likelihood and return the confidence."""
        self._sum = likelihood + self._forgetting * self._sum
        self._weight = 1.0 + self._forgetting * self._weight
        return self._sum / self._weight
