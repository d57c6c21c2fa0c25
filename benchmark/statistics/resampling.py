"""Drawing episodes anew within their cells, and how much that understates the spread."""

import math
from collections.abc import Hashable, Iterable
from typing import TypeVar

import numpy as np
from numpy.typing import NDArray

from ...agents.errors import InputError
from .samples import FloatArray

Cells = list[NDArray[np.intp]]
"""The indices of the episodes of each cell."""

Deviate = TypeVar("Deviate", float, FloatArray)


def cells_of(strata: Iterable[Hashable], episodes: int) -> Cells:
    """Return the indices of the episodes of each cell, cells in order of appearance.

    Raises
    ------
    InputError
        If there is not one label for each of the ``episodes``.
    """
    members: dict[Hashable, list[int]] = {}
    for index, stratum in enumerate(strata):
        members.setdefault(stratum, []).append(index)
    labelled = sum(len(cell) for cell in members.values())
    if labelled != episodes:
        raise InputError(f"strata has {labelled} labels; it must have one for each of {episodes}")
    return [np.array(cell, dtype=np.intp) for cell in members.values()]


def resample(cells: Cells, resamples: int, seed: int) -> NDArray[np.intp]:
    """Return indices of resampled episodes, shape (resamples, n), drawn cell by cell."""
    rng = np.random.default_rng(seed)
    return np.concatenate([rng.choice(cell, (resamples, cell.size)) for cell in cells], axis=1)


def expanded(z: Deviate, cells: Cells) -> Deviate:
    r"""Return where the resampled distribution reaches as far as the normal deviate z should.

    .. math:: \sqrt{\tfrac{n}{n - c}} \; t_{\Phi(z), \, n - c}

    for n episodes in c cells of two or more: the root corrects the variance of a resample, too
    small by (m - 1) / m in a cell of m episodes, and Student's t the uncertainty of that variance
    (Hesterberg 2015). If no cell has two episodes, z itself.
    """
    sizes = [cell.size for cell in cells if cell.size > 1]
    dof = sum(sizes) - len(sizes)
    return _student_t(z, dof) * math.sqrt(sum(sizes) / dof) if dof else z


def _student_t(z: Deviate, dof: int) -> Deviate:
    """Return Student's t quantile from the normal one (Abramowitz & Stegun 26.7.5)."""
    return z + (z**3 + z) / (4 * dof) + (5 * z**5 + 16 * z**3 + 3 * z) / (96 * dof**2)
