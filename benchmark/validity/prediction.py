"""The prediction of a source by a suite: the order and the size of the policies' scores."""

from dataclasses import dataclass
from typing import Final

import numpy as np
from colift.benchmark.statistics import FloatArray
from colift.benchmark.validity.correlation import kendall, spearman
from colift.benchmark.validity.quantity import Quantity
from colift.benchmark.validity.scores import Scores

FEWEST_BETTER: Final = 3
"""Fewest policies that beat two people for a correlation among them."""


@dataclass(frozen=True, kw_only=True)
class BetterThanPeople:
    """Agreement about the policies whose ratio to two people on the suite is below 1.

    A reader of a board chooses from these; ``copy`` and its like have no influence.
    """

    policies: tuple[str, ...]
    """Their names, the best on the suite first."""
    spearman: Quantity
    kendall: Quantity


@dataclass(frozen=True, kw_only=True)
class SuitePrediction:
    """Agreement of two sets of lifts about the same policies."""

    spearman: Quantity
    """Rank correlation of the policies' mean RMSE: 1 is the same order, 0 no relation."""
    kendall: Quantity
    """Rank correlation by pairs; the share of pairs in the same order is (1 + value) / 2."""
    kendall_best_half: Quantity
    """The same for the better half of the policies on the suite, those from which a reader of a
    board chooses: large differences between poor policies have no influence on it."""
    better: BetterThanPeople | None
    """The agreement among the policies that beat two people on the suite; None if they are fewer
    than :data:`FEWEST_BETTER`."""
    factor: Quantity
    """Typical error of a ratio to two people, as a factor: 1 is exact; 1.5 means that half of the
    policies have 1.5 times the ratio of the suite, or 1 / 1.5 of it, or deviate further."""
    bias: Quantity
    """Median ratio to two people on the source, relative to the suite: above 1, policies are
    further behind two people on the source than on the suite."""
    fall_behind: tuple[str, ...]
    """Policies that are better than two people on the suite and worse on the source, with intervals
    of their ratios that exclude 1 on both."""
    overtake: tuple[str, ...]
    """Policies that are worse than two people on the suite and better on the source, likewise."""


def predict(source: Scores, suite: Scores) -> SuitePrediction:
    r"""Return measures of how well the scores on a suite predict those on a source.

    The order is that of the mean RMSE, the score by which boards rank. The size is the ratio of
    each policy to the human-human baseline of the same lifts, r on the source and s on the suite:

    .. math:: \text{factor} = \exp\left(\operatorname{median}_p |\ln (r_p / s_p)|\right), \quad
        \text{bias} = \exp\left(\operatorname{median}_p \ln (r_p / s_p)\right)

    The intervals are of resamples of the people of both, each with the same people for all
    policies: they show how much other people would change a number, not other policies. Where a
    source does not name its people, its recordings are resampled, and the intervals hold for other
    lifts of these people.

    Parameters
    ----------
    source, suite
        Scores of the same policies in the same order.
    """
    samples = (source.units, suite.units)
    drawn = source.resampled, suite.resampled
    off = np.log(source.ratios / suite.ratios)
    drawn_off = np.log(source.resampled_ratios / suite.resampled_ratios)

    sides = {
        name: (_side(suite.vs_human(name)), _side(source.vs_human(name))) for name in suite.policies
    }

    def factor(logarithms: FloatArray) -> FloatArray:
        found: FloatArray = np.exp(np.median(logarithms, axis=-1))
        return found

    half = np.sort(suite.means.argsort(kind="stable")[: (len(suite.policies) + 1) // 2])
    return SuitePrediction(
        spearman=Quantity.resampled(
            float(spearman(source.means, suite.means)), spearman(*drawn), *samples
        ),
        kendall=Quantity.resampled(
            float(kendall(source.means, suite.means)), kendall(*drawn), *samples
        ),
        kendall_best_half=Quantity.resampled(
            float(kendall(source.means[half], suite.means[half])),
            kendall(*(each[:, half] for each in drawn)),
            *samples,
        ),
        better=_better_than_people(source, suite),
        factor=Quantity.resampled(float(factor(np.abs(off))), factor(np.abs(drawn_off)), *samples),
        bias=Quantity.resampled(float(factor(off)), factor(drawn_off), *samples),
        fall_behind=tuple(name for name in sides if sides[name] == (-1, 1)),
        overtake=tuple(name for name in sides if sides[name] == (1, -1)),
    )


def _better_than_people(source: Scores, suite: Scores) -> BetterThanPeople | None:
    chosen = np.flatnonzero(suite.ratios < 1.0)
    if len(chosen) < FEWEST_BETTER:
        return None
    means = source.means[chosen], suite.means[chosen]
    drawn = source.resampled[:, chosen], suite.resampled[:, chosen]
    samples = (source.units, suite.units)
    names = {suite.policies[i] for i in chosen}
    return BetterThanPeople(
        policies=tuple(name for name in suite.order() if name in names),
        spearman=Quantity.resampled(float(spearman(*means)), spearman(*drawn), *samples),
        kendall=Quantity.resampled(float(kendall(*means)), kendall(*drawn), *samples),
    )


def _side(ratio: Quantity) -> int:
    """Return -1 for a ratio below 1, 1 for one above it, 0 if its interval contains 1."""
    return int(ratio.low > 1.0) - int(ratio.high < 1.0)
