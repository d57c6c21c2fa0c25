"""A number with its interval."""

from dataclasses import dataclass

from colift.benchmark.statistics import Estimate, FloatArray, Units
from colift.benchmark.statistics.bootstrap import expanded_percentile, expansion


@dataclass(frozen=True, kw_only=True)
class Quantity:
    """A number with its 95 % interval."""

    value: float
    low: float
    high: float

    @classmethod
    def of(cls, estimate: Estimate) -> "Quantity":
        """Return an estimate with its interval; scores have one, since they have two people."""
        low, high = estimate.ends
        return cls(value=estimate.mean, low=low, high=high)

    @classmethod
    def resampled(cls, value: float, resampled: FloatArray, *units: Units) -> "Quantity":
        """Return a number with the expanded percentile interval of its resamples, shape (n,).

        If several samples were resampled independently, each with its units, the largest of their
        expansions is used.
        """
        found = expanded_percentile(resampled, max(units, key=expansion))
        low, high = found or (value, value)
        return cls(value=float(value), low=low, high=high)
