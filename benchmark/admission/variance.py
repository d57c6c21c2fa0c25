"""The shares of policy, person and their interaction in the variance of errors."""

from dataclasses import dataclass

import numpy as np
from colift.base.errors import InputError
from numpy.typing import ArrayLike


@dataclass(frozen=True, kw_only=True)
class VarianceShares:
    """Shares in the variance of the expected log errors of policies and people.

    A share may be below 0 where there is nothing but noise.
    """

    policy: float
    """Some policies are better with everybody."""
    person: float
    """Some people are harder for every policy."""
    interaction: float
    """Some policies suit some people."""
    variance: float
    """The variance of the interaction itself, of logarithms."""

    @property
    def between_people(self) -> float:
        """Share of the interaction in what people change, whatever the policies' means."""
        person, suits = max(self.person, 0.0), max(self.interaction, 0.0)
        return suits / (person + suits) if suits else 0.0


def variance_shares(errors: ArrayLike) -> VarianceShares:
    r"""Return the shares of an analysis of variance with the noise of single lifts removed.

    The logarithm of the error of the policy p with the person h in the person's lift k is

    .. math::

        x_{phk} = \mu + \alpha_p + \beta_h + \gamma_{ph} + \lambda_{hk} + \delta_{pk}
                  + \varepsilon_{phk}

    where k is the same behaviour for everybody. The mean squares of policies, people, their
    interaction, lifts and the rest give the variances of :math:`\alpha`, :math:`\beta` and
    :math:`\gamma` without bias. With one lift of each behaviour, what suits a person with one
    behaviour alone counts as noise.

    Parameters
    ----------
    errors
        (policies, people, lifts) positive errors.

    Raises
    ------
    InputError
        If there are fewer than two policies, people or lifts.
    """
    x = np.log(np.asarray(errors, dtype=np.float64))
    if x.ndim != 3 or min(x.shape) < 2:
        raise InputError(f"shares need 2 policies, people and lifts or more, got {x.shape}")
    p, h, k = x.shape
    x = x - x.mean()
    cells, lifts, ways = x.mean(axis=2), x.mean(axis=0), x.mean(axis=1)
    rows, columns, kinds = cells.mean(axis=1), cells.mean(axis=0), lifts.mean(axis=0)
    suits = cells - rows[:, np.newaxis] - columns
    shared = lifts - columns[:, np.newaxis] - kinds
    ways = ways - rows[:, np.newaxis] - kinds
    rest = x - cells[..., np.newaxis] - (shared + kinds) - ways[:, np.newaxis]
    of_policy = h * k * (rows**2).sum() / (p - 1)
    of_person = p * k * (columns**2).sum() / (h - 1)
    of_suits = k * (suits**2).sum() / ((p - 1) * (h - 1))
    of_lifts = p * (shared**2).sum() / ((h - 1) * (k - 1))
    of_rest = (rest**2).sum() / ((p - 1) * (h - 1) * (k - 1))
    parts = (
        (of_policy - of_suits) / (h * k),
        (of_person - of_suits - of_lifts + of_rest) / (p * k),
        (of_suits - of_rest) / k,
    )
    total = sum(max(part, 0.0) for part in parts)
    policy, person, interaction = (float(part / total) if total > 0 else 0.0 for part in parts)
    return VarianceShares(
        policy=policy, person=person, interaction=interaction, variance=float(parts[2])
    )
