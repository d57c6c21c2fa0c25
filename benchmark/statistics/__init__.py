"""Statistics of a sample of people: averages, intervals, tests and ranks.

People are drawn, and each is in one or more episodes. All episodes of a person stay together
(:class:`.Units`): an interval shows how much a number would change with other people from the same
population, not with other behaviours.

Smoothness is missing (NaN) in episodes in which the robot did not move. Its summary is the mean
over the episodes that have a value *and* the count of those that do not. A ranking by smoothness
ranks by that count first, so that moving only when it is easy never helps. Intervals accept no NaN:
leave out the missing episodes, with their people, first.

References
----------
W. G. Cochran (1977). Sampling Techniques, 3rd ed., Wiley (means of clusters, collapsed strata).

T. Hesterberg (2015). What teachers should know about the bootstrap: resampling in the
undergraduate statistics curriculum. The American Statistician 69(4):371-386.

R. Agarwal et al. (2021). Deep reinforcement learning at the edge of the statistical precipice.
NeurIPS 34 (interquartile mean, probability of improvement).
"""

from colift.benchmark.statistics.averages import (
    MeanWithMissing,
    interquartile_mean,
    mean_with_missing,
)
from colift.benchmark.statistics.estimate import (
    Estimate,
    PairedDifference,
    difference_of_means,
    geometric_ratio,
    log_ratios,
    mean_of,
    paired_difference,
    ratio_of_means,
)
from colift.benchmark.statistics.permutation import (
    holm_correction,
    paired_permutation_p,
    permutation_ps_against,
)
from colift.benchmark.statistics.ranking import LEVEL, Family, all_pairs, decisive
from colift.benchmark.statistics.samples import FloatArray, Interval
from colift.benchmark.statistics.superiority import probability_better, share_better
from colift.benchmark.statistics.units import Units

__all__ = [
    "LEVEL",
    "Estimate",
    "Family",
    "FloatArray",
    "Interval",
    "MeanWithMissing",
    "PairedDifference",
    "Units",
    "all_pairs",
    "decisive",
    "difference_of_means",
    "geometric_ratio",
    "holm_correction",
    "interquartile_mean",
    "log_ratios",
    "mean_of",
    "mean_with_missing",
    "paired_difference",
    "paired_permutation_p",
    "permutation_ps_against",
    "probability_better",
    "ratio_of_means",
    "share_better",
]
