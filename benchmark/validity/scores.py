"""Scores of policies and of two people on the same lifts, and their resamples."""

import functools
from collections.abc import Hashable, Mapping
from dataclasses import dataclass, field
from typing import Final

import numpy as np
from colift.benchmark.statistics import FloatArray
from colift.benchmark.statistics.bootstrap import expanded_percentile
from colift.benchmark.statistics.samples import Members, expanded, members_of, resample
from numpy.typing import NDArray

RESAMPLES: Final = 2000

CONFIDENCE: Final = 0.95


@dataclass(frozen=True, kw_only=True)
class Quantity:
    """A number with its 95 % interval."""

    value: float
    low: float
    high: float

    @classmethod
    def of(cls, value: float, resampled: FloatArray, *members: Members) -> "Quantity":
        """Return a number with the expanded percentile interval of its resamples, shape (n,).

        If several samples were resampled independently, each with its members, the largest of their
        expansions is used.
        """
        widest = max(members, key=lambda each: expanded(1.0, each))
        low, high = expanded_percentile(resampled, widest, CONFIDENCE)
        return cls(value=float(value), low=low, high=high)


@dataclass(frozen=True, kw_only=True, eq=False)
class Scores:
    """RMSE of policies and of two people on the same lifts, those of a suite or of a source."""

    name: str
    digest: str
    """Digest of the lifts."""
    strata: tuple[Hashable, ...] = field(repr=False)
    """Label of each lift: lifts are resampled within their label."""
    errors: Mapping[str, FloatArray] = field(repr=False)
    """RMSE of each policy in each lift [mm], shape (n,)."""
    human_human: FloatArray = field(repr=False)
    """RMSE of the human-human baseline in each lift [mm], shape (n,)."""
    seed: int
    """Seed of the resamples; those of independent samples differ."""
    shipped: tuple[str, ...] = ()
    """Policies whose scores were known and not played."""
    failed: Mapping[str, int] = field(default_factory=dict)
    """Failed lifts of the policies that were played, with the worst RMSE; those without one are
    left out."""

    @property
    def policies(self) -> tuple[str, ...]:
        """The names of the policies."""
        return tuple(self.errors)

    @property
    def lifts(self) -> int:
        """Number of lifts."""
        return len(self.human_human)

    @functools.cached_property
    def members(self) -> Members:
        """The indices of the lifts of each label."""
        return members_of(self.strata, self.lifts)

    @functools.cached_property
    def means(self) -> FloatArray:
        """Mean RMSE of each policy [mm], shape (k,): the score by which boards rank."""
        return np.array([errors.mean() for errors in self.errors.values()])

    @functools.cached_property
    def ratios(self) -> FloatArray:
        """Mean RMSE of each policy over that of the human-human baseline, shape (k,)."""
        found: FloatArray = self.means / self.human_human.mean()
        return found

    @functools.cached_property
    def resampled(self) -> FloatArray:
        """Mean RMSE of each policy in each resample [mm], shape (resamples, k)."""
        return np.stack([errors[self._drawn].mean(axis=1) for errors in self.errors.values()], 1)

    @functools.cached_property
    def resampled_ratios(self) -> FloatArray:
        """The :attr:`ratios` in each resample, shape (resamples, k)."""
        found: FloatArray = self.resampled / self._resampled_human_human[:, None]
        return found

    @functools.cached_property
    def human_human_mm(self) -> Quantity:
        """Mean RMSE of the human-human baseline [mm]."""
        return Quantity.of(self.human_human.mean(), self._resampled_human_human, self.members)

    def mean(self, policy: str) -> float:
        """Return the mean RMSE of a policy [mm]."""
        return float(self.errors[policy].mean())

    def mean_mm(self, policy: str) -> Quantity:
        """Return the mean RMSE of a policy with its interval [mm]."""
        place = self.policies.index(policy)
        return Quantity.of(self.means[place], self.resampled[:, place], self.members)

    def vs_human(self, policy: str) -> Quantity:
        """Return the ratio of a policy to the human-human baseline."""
        place = self.policies.index(policy)
        return Quantity.of(self.ratios[place], self.resampled_ratios[:, place], self.members)

    def order(self) -> tuple[str, ...]:
        """Return the policies in the order of their mean RMSE, the best first."""
        return tuple(self.policies[i] for i in self.means.argsort(kind="stable"))

    def place(self, policy: str) -> int:
        """Return the place of a policy in the order, 1 for the best."""
        return self.order().index(policy) + 1

    @functools.cached_property
    def _resampled_human_human(self) -> FloatArray:
        return np.asarray(self.human_human[self._drawn].mean(axis=1))

    @functools.cached_property
    def _drawn(self) -> NDArray[np.intp]:
        # All policies take the same resampled lifts: the difficulty of a lift cancels.
        return resample(self.members, RESAMPLES, self.seed)
