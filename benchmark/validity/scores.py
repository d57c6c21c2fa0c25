"""Scores of policies and of two people on the same lifts, and their resamples."""

import functools
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Final

import numpy as np
from colift.base.errors import InputError
from colift.benchmark.statistics import (
    FloatArray,
    Units,
    geometric_ratio,
    log_ratios,
    mean_of,
)
from colift.benchmark.statistics.bootstrap import resampled_means, resampled_weights
from colift.benchmark.validity.beside_pairs import BesidePairs
from colift.benchmark.validity.quantity import Quantity

RESAMPLES: Final = 2000


@dataclass(frozen=True, kw_only=True, eq=False)
class Scores:
    """RMSE of policies and of two people on the same lifts, those of a suite or of a source.

    Raises
    ------
    InputError
        If all lifts are of one person.
    """

    name: str
    digest: str
    """Digest of the lifts."""
    units: Units = field(repr=False)
    """The people of these lifts; they are resampled with all of their lifts."""
    errors: Mapping[str, FloatArray] = field(repr=False)
    """RMSE of each policy in each lift [mm], shape (n,)."""
    human_human: FloatArray = field(repr=False)
    """RMSE of the human-human baseline in each lift [mm], shape (n,)."""
    seed: int
    """Seed of the resamples; those of independent samples differ."""
    shipped: tuple[str, ...] = ()
    """Policies whose scores were known and not played."""
    beside: BesidePairs | None = None
    """The scores beside those of the recorded pairs themselves; None without such pairs."""
    failed: Mapping[str, int] = field(default_factory=dict)
    """Failed lifts of the policies that were played, with the worst RMSE; those without one are
    left out."""

    def __post_init__(self) -> None:
        if self.units.freedom == 0:
            raise InputError(f"all lifts of {self.name} are of one person; intervals need two")

    @property
    def policies(self) -> tuple[str, ...]:
        """The names of the policies."""
        return tuple(self.errors)

    @property
    def lifts(self) -> int:
        """Number of lifts."""
        return len(self.human_human)

    @functools.cached_property
    def means(self) -> FloatArray:
        """Mean RMSE of each policy [mm], shape (k,): the score by which boards rank."""
        return np.array([errors.mean() for errors in self.errors.values()])

    @functools.cached_property
    def ratios(self) -> FloatArray:
        """Ratio of each policy to the human-human baseline, geometric mean, shape (k,)."""
        found: FloatArray = np.exp(self._logs.mean(axis=1))
        return found

    @functools.cached_property
    def resampled(self) -> FloatArray:
        """Mean RMSE of each policy in each resample [mm], shape (resamples, k)."""
        return resampled_means(np.array(list(self.errors.values())), self.units, self._weights).T

    @functools.cached_property
    def resampled_ratios(self) -> FloatArray:
        """The :attr:`ratios` in each resample, shape (resamples, k)."""
        found: FloatArray = np.exp(resampled_means(self._logs, self.units, self._weights).T)
        return found

    @functools.cached_property
    def human_human_mm(self) -> Quantity:
        """Mean RMSE of the human-human baseline [mm]."""
        return Quantity.of(mean_of(self.human_human, self.units))

    def mean(self, policy: str) -> float:
        """Return the mean RMSE of a policy [mm]."""
        return float(self.errors[policy].mean())

    def mean_mm(self, policy: str) -> Quantity:
        """Return the mean RMSE of a policy with its interval [mm]."""
        return Quantity.of(mean_of(self.errors[policy], self.units))

    def vs_human(self, policy: str) -> Quantity:
        """Return the ratio of a policy to the human-human baseline."""
        return Quantity.of(geometric_ratio(self.errors[policy], self.human_human, self.units))

    def order(self) -> tuple[str, ...]:
        """Return the policies in the order of their mean RMSE, the best first."""
        return tuple(self.policies[i] for i in self.means.argsort(kind="stable"))

    def place(self, policy: str) -> int:
        """Return the place of a policy in the order, 1 for the best."""
        return self.order().index(policy) + 1

    @functools.cached_property
    def _logs(self) -> FloatArray:
        rows = self.errors.values()
        return np.array([log_ratios(errors, self.human_human) for errors in rows])

    @functools.cached_property
    def _weights(self) -> FloatArray:
        # All policies take the same resampled people: the difficulty of a lift cancels.
        return resampled_weights(self.units, RESAMPLES, self.seed)
