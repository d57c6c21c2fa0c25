"""Samples: one value per episode, pairs on the same episodes, and resampling within strata."""

import copy
import functools
import math
from collections.abc import Callable, Hashable, Iterable, Iterator
from typing import Final, TypeVar

import numpy as np
from colift.base.errors import InputError
from numpy.typing import ArrayLike, NDArray

FloatArray = NDArray[np.float64]
Interval = tuple[float, float]


def sample(name: str, values: ArrayLike) -> FloatArray:
    """Return the values of the episodes as an array, shape (n,).

    Raises
    ------
    InputError
        If there are no values, not one number per episode, or one is not finite; the message calls
        them ``name``.
    """
    x = np.asarray(values, dtype=np.float64)
    if x.ndim != 1 or x.size == 0:
        raise InputError(f"{name} has shape {x.shape}; it must be one value per episode, (n,)")
    if not np.isfinite(x).all():
        index = int(np.isfinite(x).argmin())
        raise InputError(f"{name}[{index}] is {x[index]}; it must be a number for each episode")
    return x


def paired(name_a: str, a: ArrayLike, name_b: str, b: ArrayLike) -> tuple[FloatArray, FloatArray]:
    """Return two samples of the same episodes, each of shape (n,).

    Raises
    ------
    InputError
        As :func:`sample`, or if they are of unequal length.
    """
    x, y = sample(name_a, a), sample(name_b, b)
    if x.size != y.size:
        raise InputError(f"{name_a} has {x.size} episodes, {name_b} {y.size}; pairs are needed")
    return x, y


Members = list[NDArray[np.intp]]
"""The indices of the episodes of each stratum."""

Deviate = TypeVar("Deviate", float, FloatArray)
"""One standard normal deviate, or many."""


def members_of(strata: Iterable[Hashable], episodes: int) -> Members:
    """Return the indices of the episodes of each stratum, in order of appearance.

    Raises
    ------
    InputError
        If there is not one label for each of the ``episodes``.
    """
    members: dict[Hashable, list[int]] = {}
    for index, label in enumerate(strata):
        members.setdefault(label, []).append(index)
    labelled = sum(len(stratum) for stratum in members.values())
    if labelled != episodes:
        raise InputError(f"strata has {labelled} labels; it must have one for each of {episodes}")
    return [np.array(stratum, dtype=np.intp) for stratum in members.values()]


def resample(members: Members, resamples: int, seed: int) -> NDArray[np.intp]:
    """Return indices of resampled episodes, shape (resamples, n), drawn stratum by stratum.

    The array is shared by all callers with the same draw, and is read-only.
    """
    return _drawn(tuple(stratum.tobytes() for stratum in members), resamples, seed)


@functools.lru_cache(maxsize=4)
def _drawn(strata: tuple[bytes, ...], resamples: int, seed: int) -> NDArray[np.intp]:
    # Drawing takes ten times as long as a mean; the scores of a run share their strata.
    rng = np.random.default_rng(seed)
    members = [np.frombuffer(stratum, dtype=np.intp) for stratum in strata]
    drawn = np.concatenate(
        [rng.choice(stratum, (resamples, stratum.size)) for stratum in members], axis=1
    )
    drawn.setflags(write=False)
    return drawn


MOST_DRAWN: Final = 2**20
"""Largest number of indices that are drawn at once and kept for the next statistic."""

BLOCK: Final = 2**17
"""Number of indices, at most, in each part of a larger draw."""


def resampled(
    statistic: Callable[[NDArray[np.intp]], FloatArray],
    members: Members,
    resamples: int,
    seed: int,
) -> FloatArray:
    """Return a statistic of each resample of :func:`resample`, shape (resamples,).

    ``statistic`` is a function of the indices of resampled episodes, (k, n), and has k values. In a
    large sample it is called with a few resamples at a time, whose memory is bounded.
    """
    episodes = sum(stratum.size for stratum in members)
    if resamples * episodes <= MOST_DRAWN:
        return statistic(resample(members, resamples, seed))
    rows = max(1, BLOCK // episodes)
    sizes = [min(rows, resamples - first) for first in range(0, resamples, rows)]
    return np.concatenate([statistic(block) for block in _blocks(members, sizes, seed)])


def _blocks(members: Members, sizes: list[int], seed: int) -> Iterator[NDArray[np.intp]]:
    """Yield the rows of :func:`resample` in blocks; each stratum has its part of the draws."""
    rng, streams = np.random.default_rng(seed), []
    for stratum in members:
        streams.append(copy.deepcopy(rng))
        for size in sizes:
            rng.choice(stratum, (size, stratum.size))
    for size in sizes:
        parts = zip(streams, members, strict=True)
        yield np.concatenate([own.choice(some, (size, some.size)) for own, some in parts], axis=1)


def expanded(z: Deviate, members: Members) -> Deviate:
    r"""Return the deviate to use in the resampled distribution for the normal deviate z.

    .. math:: \sqrt{\tfrac{n}{n - c}} \; t_{\Phi(z), \, n - c}

    for n episodes in c strata of two or more: the root corrects the variance of a resample, which
    is too small by (m - 1) / m in a stratum of m episodes, and Student's t accounts for the
    uncertainty of that variance (Hesterberg 2015). If no stratum has two episodes, it is z itself.
    """
    sizes = [stratum.size for stratum in members if stratum.size > 1]
    dof = sum(sizes) - len(sizes)
    return _student_t(z, dof) * math.sqrt(sum(sizes) / dof) if dof else z


def _student_t(z: Deviate, dof: int) -> Deviate:
    """Return Student's t quantile from the normal one (Abramowitz & Stegun 26.7.5)."""
    z2 = z * z
    first, second = (z2 + 1) * z, ((5 * z2 + 16) * z2 + 3) * z
    return z + first / (4 * dof) + second / (96 * dof**2)
