"""Weights that are fitted again to each person, by recursive least squares."""

from dataclasses import dataclass

import numpy as np
from colift.base.errors import InputError
from numpy.typing import NDArray


@dataclass(frozen=True, kw_only=True)
class RefittingParameters:
    """Parameters of a policy whose weights learn from each lift."""

    remember: bool = True
    """Whether it learns from lift to lift; without, each lift is the first."""
    doubt: float = 1.0
    """Variance of the weights before the first lift, over that of the errors [1/m2]."""

    def __post_init__(self) -> None:
        """Check the range.

        Raises
        ------
        InputError
            If the doubt is negative or not finite.
        """
        if not 0 <= self.doubt < np.inf:
            raise InputError(f"doubt must be a number of at least 0, got {self.doubt}")


class LeastSquares:
    """Weights of a linear function, improved by each sample x with the value y.

    By recursive least squares,

        k = P x / (1 + x' P x),  w <- w + k (y - x' w),  P <- P - k x' P,

    with P = doubt I at first.

    Parameters
    ----------
    weights
        The first weights (n,).
    doubt
        Their variance, over that of the errors.
    """

    def __init__(self, weights: NDArray[np.float64], doubt: float) -> None:
        self.weights = weights
        self._cov = doubt * np.eye(len(weights))

    def value(self, x: NDArray[np.float64]) -> float:
        """Return x' w."""
        return float((x * self.weights).sum())

    def add(self, x: NDArray[np.float64], y: float) -> None:
        """Improve the weights by a sample."""
        spread = (self._cov * x).sum(axis=1)
        gain = spread / (1.0 + float((x * spread).sum()))
        self.weights = self.weights + gain * (y - self.value(x))
        self._cov = self._cov - gain[:, None] * spread
