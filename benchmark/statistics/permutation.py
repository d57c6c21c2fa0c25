"""The paired permutation test, by sign flips of people, and the correction for many tests.

References
----------
B. Phipson, G. K. Smyth (2010). Permutation p-values should never be zero: calculating exact
p-values when permutations are randomly drawn. Statistical Applications in Genetics and Molecular
Biology 9(1):39.

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
from colift.benchmark.statistics.units import Units
from numpy.typing import ArrayLike

ROUNDING: Final = 1e-9
"""Flips that give the same sum in another order of rounding count as equal: relative bound."""


def paired_permutation_p(
    a: ArrayLike, b: ArrayLike, units: Units, *, resamples: int = 10_000, seed: int = 0
) -> float:
    """Return the two-sided p value for "a and b do not differ", by sign flips of people.

    Under this hypothesis, the sum of a person's differences a - b is equally likely with the other
    sign. The p value is the share of sign flips, including the observed signs, whose total is at
    least as far from zero; it is never below 1 / (flips + 1) (Phipson & Smyth 2010). See
    :func:`sign_flips`.

    Parameters
    ----------
    a, b
        Values of two policies on the same episodes in the same order, each of shape (n,).
    units
        The people of these episodes.
    resamples
        Largest number of sign flips.
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
    (p,) = permutation_ps_against(a, [b], units, resamples=resamples, seed=seed)
    return p


def permutation_ps_against(
    a: ArrayLike,
    others: Sequence[ArrayLike],
    units: Units,
    *,
    resamples: int = 10_000,
    seed: int = 0,
) -> list[float]:
    """Return :func:`paired_permutation_p` of ``a`` and each of the others.

    The p values are not corrected for their number; see :func:`.holm_correction`.

    Raises
    ------
    InputError
        As :func:`paired_permutation_p`.
    """
    sample("a", a)
    if not others:
        return []
    differences = units.sums(np.stack([np.subtract(*paired("a", a, "b", b)) for b in others]))
    signs = sign_flips(units.count, resamples, seed)
    least = np.abs(differences.sum(axis=1)) - ROUNDING * np.abs(differences).sum(axis=1)
    extreme = (np.abs(signs @ differences.T) >= least).sum(axis=0)
    return [(1 + int(count)) / (1 + len(signs)) for count in extreme]


@functools.lru_cache(maxsize=16)
def sign_flips(units: int, resamples: int, seed: int = 0) -> FloatArray:
    """Return sign flips of a number of units, 1 or -1, shape (flips, units), read-only.

    They are random ones, or all others than the observed signs where these are fewer: opposite
    flips have the same distance from zero, so that one of each two is enough.
    """
    others = 2 ** (units - 1) - 1
    if others <= resamples:
        flipped = np.arange(1, 1 + others)[:, None] >> np.arange(units) & 1
    else:
        flipped = np.random.default_rng(seed).integers(0, 2, (resamples, units))
    signs: FloatArray = 1.0 - 2.0 * flipped.astype(np.float64)
    signs.setflags(write=False)
    return signs


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
