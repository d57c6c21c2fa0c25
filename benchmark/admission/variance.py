"""The shares of policy, human and their interaction in the variance of errors."""

from dataclasses import dataclass

import numpy as np
from colift.base.errors import InputError
from numpy.typing import ArrayLike


@dataclass(frozen=True, kw_only=True)
class VarianceShares:
    """Shares of the variance of a table of policies (rows) and humans (columns); their sum is 1."""

    policy: float
    """Share of the row means: some policies are better with everybody."""
    human: float
    """Share of the column means: some humans are harder for every policy."""
    interaction: float
    """Share of the rest: some policies suit some humans."""


def variance_shares(table: ArrayLike) -> VarianceShares:
    r"""Return the shares of a two-way analysis of variance without replication.

    .. math:: x_{ph} = \mu + \alpha_p + \beta_h + \gamma_{ph}

    Parameters
    ----------
    table
        (policies, humans) mean of the logarithm of the error.

    Raises
    ------
    InputError
        If there are fewer than two policies or humans, or all values are the same.
    """
    values = np.asarray(table, dtype=np.float64)
    if values.ndim != 2 or min(values.shape) < 2:
        raise InputError(f"shares need two policies and two humans or more, got {values.shape}")
    centred = values - values.mean()
    rows, columns = centred.mean(axis=1), centred.mean(axis=0)
    left = centred - rows[:, np.newaxis] - columns
    parts = [float((rows**2).mean()), float((columns**2).mean()), float((left**2).mean())]
    total = sum(parts)
    if total == 0.0:
        raise InputError("all policies have the same error with all humans")
    policy, human, interaction = (part / total for part in parts)
    return VarianceShares(policy=policy, human=human, interaction=interaction)
