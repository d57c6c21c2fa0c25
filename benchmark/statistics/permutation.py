"""The paired permutation test, by random sign flips, and the correction for many tests.

References
----------
B. Phipson, G. K. Smyth (2010). Permutation p-values should never be zero: calculating exact
p-values when permutations are randomly drawn. Statistical Applications in Genetics and Molecular
Biology 9(1):39.

J. Besag, P. Clifford (1991). Sequential Monte Carlo p-values. Biometrika 78(2):301-304.

V. K. Bentkus, D. Dzindzalieta (2015). A tight Gaussian bound for weighted sums of Rademacher random
variables. Bernoulli 21(2):1231-1237.

S. Holm (1979). A simple sequentially rejective multiple test procedure. Scandinavian Journal of
Statistics 6(2):65-70.
"""

import functools
import math
from collections.abc import Sequence
from statistics import NormalDist
from typing import Final

import numpy as np
from colift.base.errors import InputError
from colift.benchmark.statistics.samples import FloatArray, paired, sample
from numpy.typing import ArrayLike, NDArray

BLOCK: Final = 256
"""Number of tests made by one product of matrices."""

CHUNK: Final = 10_000
"""Number of sign flips that are drawn at once."""

STOPS: Final = ((1_000, 100), (CHUNK, 10))
"""A sequential test stops if, of that many flips, that many are as far from zero as the observed
signs. The p value of 0.1 with which it may stop early is seven standard errors above 0.05; the one
of 0.001, with which it may stop after each chunk, has a standard error of a third."""

Signs = NDArray[np.int8]
"""Sign flips, shape (resamples, n)."""


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
    extreme = _extreme(np.stack(differences), signs) if differences else ()
    return [(1 + int(count)) / (1 + resamples) for count in extreme]


def sequential_permutation_ps(
    differences: FloatArray, *, resamples: int = 10_000, seed: int = 0
) -> FloatArray:
    """Return the p value of each row of differences, with fewer sign flips where it is large.

    A row takes part until enough flips are at least as far from zero as the observed signs (Besag &
    Clifford 1991), see :data:`STOPS`: whether a p value is 0.2 or 0.3 does not matter. Where all
    flips are made, this is :func:`permutation_ps_against`.

    Parameters
    ----------
    differences
        Differences of pairs of policies on the same episodes, shape (k, n).
    resamples
        Largest number of sign flips of a row.
    seed
        Seed of the flips.

    Returns
    -------
    array
        p values, shape (k,), not corrected for their number.
    """
    extreme, flips = np.zeros((2, len(differences)), dtype=np.int64)
    running = np.arange(len(differences))
    for number, first in enumerate(range(0, resamples, CHUNK)):
        signs = _signs(differences.shape[1], min(CHUNK, resamples - first), seed, number)
        begun = 0
        for stop, enough in STOPS if number == 0 else STOPS[-1:]:
            some = signs[begun:stop]
            extreme[running] += _extreme(differences[running], some)
            flips[running] += len(some)
            running = running[extreme[running] < enough]
            begun = stop
        if not running.size:
            break
    ps: FloatArray = (1 + extreme) / (1 + flips)
    return ps


@functools.lru_cache(maxsize=32)
def _signs(episodes: int, resamples: int, seed: int, number: int = 0) -> Signs:
    # Drawing the signs takes ten times as long as a test, and many tests are on the same episodes.
    rng = np.random.default_rng((seed, number) if number else seed)
    signs = rng.choice(np.array((-1, 1), dtype=np.int8), (resamples, episodes))
    signs.setflags(write=False)
    return signs


def _extreme(differences: FloatArray, signs: Signs) -> NDArray[np.int64]:
    """Return for each row of differences, shape (k, n), the number of flips as far from zero."""
    flips = signs.astype(np.float64)
    # Flips that give the same sum in another order of rounding count as equal.
    least = np.abs(differences.sum(axis=1)) - 1e-9 * np.abs(differences).sum(axis=1)
    found = np.empty(len(differences), dtype=np.int64)
    for first in range(0, len(differences), BLOCK):
        some = slice(first, first + BLOCK)
        sums = flips @ differences[some].T
        found[some] = (np.abs(sums, out=sums) >= least[some]).sum(axis=0)
    return found


def far_apart(p: float) -> float:
    r"""Return the deviate beyond which a two-sided permutation p value is surely below p.

    Random signs :math:`s_i` keep every sum of differences :math:`d_i` within a normal tail
    (Bentkus & Dzindzalieta 2015, with the best constant that holds for all :math:`d`):

    .. math:: P\left(\left|\sum_i s_i d_i\right| \ge z \sqrt{\sum_i d_i^2}\right)
        \le \frac{1 - \Phi(z)}{1 - \Phi(\sqrt{2})} \cdot \frac{1}{2}
        = \frac{1 - \Phi(z)}{\operatorname{erfc}(1)}

    Parameters
    ----------
    p
        A p value, above 0 and at most 1.

    Returns
    -------
    float
        The deviate z, at least 0.
    """
    return max(0.0, -NormalDist().inv_cdf(p * math.erfc(1.0)))


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
