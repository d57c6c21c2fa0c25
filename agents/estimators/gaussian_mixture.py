"""Gaussian mixtures and Gaussian mixture regression."""

import math
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from colift.base.errors import InputError
from numpy.typing import ArrayLike, NDArray

Array = NDArray[np.float64]


@dataclass(frozen=True, kw_only=True, eq=False)
class GaussianMixture:
    """The density p(x) = sum_i w_i N(x; m_i, S_i) of k Gaussians over d variables.

    Raises
    ------
    InputError
        If the shapes do not fit together, the weights are not positive with sum 1, or a
        covariance is not symmetric and positive definite.
    """

    weights: Array
    """(k,) w, the weight of each component."""
    means: Array
    """(k, d) m, the mean of each component."""
    covariances: Array
    """(k, d, d) S, the covariance of each component."""

    def __post_init__(self) -> None:
        """Check shapes and values."""
        weights, means, covariances = self.weights, self.means, self.covariances
        if weights.ndim != 1 or means.ndim != 2:
            raise InputError(
                f"weights and means must have shapes (k,) and (k, d), got {weights.shape} and "
                f"{means.shape}"
            )
        k, d = len(weights), means.shape[1]
        if means.shape != (k, d) or covariances.shape != (k, d, d):
            raise InputError(
                f"a mixture of {k} components over {d} variables has means of shape {(k, d)} and "
                f"covariances of shape {(k, d, d)}, got {means.shape} and {covariances.shape}"
            )
        if not np.isfinite(means).all():
            raise InputError("means must be finite")
        if not (weights > 0).all() or not math.isclose(weights.sum(), 1.0, abs_tol=1e-9):
            raise InputError(f"weights must be positive and add up to 1, got {weights.tolist()}")
        for i, covariance in enumerate(covariances):
            if not np.array_equal(covariance, covariance.T) or not _is_definite(covariance):
                raise InputError(f"covariance {i} is not symmetric and positive definite")


class Conditional(NamedTuple):
    """Moments of the outputs y of a mixture, given the inputs x."""

    mean: Array
    """(m,) E[y | x]."""
    covariance: Array
    """(m, m) Cov[y | x]."""
    responsibilities: Array
    """(k,) probability of each component given x."""


class GaussianMixtureRegression:
    """Gaussian mixture regression: the moments of the outputs, given the inputs.

    With x the first variables of a mixture and y the others, component i alone gives

        m_i(x) = m_i^y + S_i^yx (S_i^xx)^-1 (x - m_i^x),
        C_i    = S_i^yy - S_i^yx (S_i^xx)^-1 S_i^xy,

    and with the responsibilities h_i(x) of the components (Ghahramani and Jordan 1994; Calinon,
    Guenter and Billard 2007)

        E[y | x]   = sum_i h_i m_i(x),
        Cov[y | x] = sum_i h_i (C_i + m_i(x) m_i(x)') - E[y | x] E[y | x]'.

    Parameters
    ----------
    mixture
        The joint density.
    inputs
        Number of its variables that are inputs.

    Raises
    ------
    InputError
        If there is no input, or no output.
    """

    def __init__(self, mixture: GaussianMixture, inputs: int) -> None:
        variables = mixture.means.shape[1]
        if not 0 < inputs < variables:
            raise InputError(f"inputs must be 1 to {variables - 1}, got {inputs}")
        x, y = slice(inputs), slice(inputs, None)
        joint = mixture.covariances
        # Inverse and slopes are computed once: a robot calls many times.
        self._precisions = np.linalg.inv(joint[:, x, x])
        self._slopes = joint[:, y, x] @ self._precisions
        self._covariances = joint[:, y, y] - self._slopes @ joint[:, x, y]
        self._means_x, self._means_y = mixture.means[:, x], mixture.means[:, y]
        volumes = np.linalg.slogdet(2 * np.pi * joint[:, x, x]).logabsdet
        self._log_weights = np.log(mixture.weights) - 0.5 * volumes

    def __call__(self, x: ArrayLike) -> Conditional:
        """Return mean and covariance of the outputs for inputs of shape (inputs,)."""
        apart = np.asarray(x) - self._means_x
        distances = np.einsum("ki,kij,kj->k", apart, self._precisions, apart)
        logs = self._log_weights - 0.5 * distances
        responsibilities = np.exp(logs - logs.max())
        responsibilities /= responsibilities.sum()
        means = self._means_y + np.einsum("kij,kj->ki", self._slopes, apart)
        mean = responsibilities @ means
        off = means - mean
        covariance = np.einsum("k,kij->ij", responsibilities, self._covariances)
        covariance += np.einsum("k,ki,kj->ij", responsibilities, off, off)
        return Conditional(mean, covariance, responsibilities)


def _is_definite(matrix: Array) -> bool:
    try:
        np.linalg.cholesky(matrix)
    except np.linalg.LinAlgError:
        return False
    return True
