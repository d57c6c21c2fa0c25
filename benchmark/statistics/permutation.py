"""The paired permutation test, by random sign flips, and the correction for many tests.

References
----------
B. Phipson, G. K. Smyth (2010). Permutation p-values should never be zero: calculating exact
p-values when permutations are randomly drawn. Statistical Applications in Genetics and Molecular
Biology 9(1):39.

S. Holm (1979). A simple sequentially rejective multiple test procedure. Scandinavian Journal of
Statistics 6(2):65-70.
"""

import functools
from collections.abc import Sequence
from typing import Final

import numpy as np
from numpy.typing import ArrayLike

from ...agents.errors import InputError
from .samples import FloatArray, paired, sample

BLOCK: Final = 32
"""Number of tests made by one product of matrices."""


def paired_permutation_p(
    a: ArrayLike, b: ArrayLike, *, resamples: int = 10_000, seed: int = 0
) -> float:
    """Return the two-sided p value for "a and b do not differ", by random sign flips.

    Under this hypothesis, each difference a - b is equally likely with the other sign. The p value
    is the share of sign flips, including the observed signs, whose mean difference is at least as
    far from zero; it is never below 1 / (resamples + 1) (Phipson & Smyth 2010).

    Parameters
    ----------
    a, b
        Values of two policies on the same episodes in the same order, each of shape (n,).
    resamples
        Number of random sign flips.
    seed
        Seed of the flips: the same inputs give the same p value.

    Returns
    -------
    float
        p value, in (0, 1].

    Raises
    ------
    InputError
        If the values are empty, not finite or of unequal length.
    """
    (p,) = permutation_ps_against(a, [b], resamples=resamples, seed=seed)
    return p


def permutation_ps_against(
    a: ArrayLike, others: Sequence[ArrayLike], *, resamples: int = 10_000, seed: int = 0
) -> list[float]:
    """Return :func:`paired_permutation_p` of ``a`` and each of the others.

    The p values are not corrected for their number; see :func:`.holm_correction`.

    Raises
    ------
    InputError
        As :func:`paired_permutation_p`.
    """
    signs = _signs(sample("a", a).size, resamples, seed)
    differences = [np.subtract(*paired("a", a, "b", b)) for b in others]
    blocks = (differences[i : i + BLOCK] for i in range(0, len(differences), BLOCK))
    return [p for block in blocks for p in _ps(np.stack(block), signs)]


@functools.lru_cache(maxsize=1)
def _signs(episodes: int, resamples: int, seed: int) -> FloatArray:
    # Drawing the signs takes ten times as long as a test, and many tests are on the same episodes.
    signs = np.random.default_rng(seed).choice((-1.0, 1.0), (resamples, episodes))
    signs.setflags(write=False)
    return signs


def _ps(differences: FloatArray, signs: FloatArray) -> list[float]:
    """Return the p value of each row of differences, shape (k, n)."""
    # Flips that give the same sum in another order of rounding count as equal.
    least = np.abs(differences.sum(axis=1)) - 1e-9 * np.abs(differences).sum(axis=1)
    extreme = (np.abs(signs @ differences.T) >= least).sum(axis=0)
    return [(1 + int(count)) / (1 + len(signs)) for count in extreme]


def holm_correction(ps: ArrayLike) -> FloatArray:
    r"""Return p values corrected for their number, by Holm's step-down procedure.

    With the m p values in increasing order,

    .. math:: \tilde p_{(i)} = \min\left(1, \max_{j \le i} \, (m - j + 1) \, p_{(j)}\right)

    If differences are declared where the corrected p value is at most 0.05, the probability of any
    error among the m is at most 5 %, however the tests depend on each other.

    Parameters
    ----------
    ps
        p values, shape (m,); m may be zero.

    Returns
    -------
    array
        Corrected p values in the order given, shape (m,): none below its uncorrected value, none
        above 1.

    Raises
    ------
    InputError
        If one is not a number from 0 to 1.
    """
    p = np.asarray(ps, dtype=np.float64)
    outside = ~((p >= 0.0) & (p <= 1.0))
    if p.ndim != 1 or outside.any():
        found = f"shape {p.shape}" if p.ndim != 1 else f"{p[outside][0]}"
        raise InputError(f"p values must be a list of numbers from 0 to 1, got {found}")
    order = p.argsort(kind="stable")
    scaled = p[order] * np.arange(p.size, 0, -1)
    corrected = np.empty_like(p)
    corrected[order] = np.minimum(1.0, np.maximum.accumulate(scaled))
    return corrected
