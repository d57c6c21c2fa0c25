"""Statistics of a sample of episodes: averages, intervals, tests and ranks.

The strata of a suite (subject x behaviour) are fixed; only the seeds within a stratum are a sample.
Therefore episodes are resampled within their stratum, never across, and an interval shows how much
another draw of seeds would change the number, not other people or other behaviours.

Smoothness is missing (NaN) in episodes in which the robot did not move. Its summary is the mean
over the episodes that have a value *and* the count of those that do not. A ranking by smoothness
ranks by that count first, so that moving only when it is easy never helps. Intervals accept no NaN:
leave out the missing episodes, with their strata, first.

References
----------
T. Hesterberg (2015). What teachers should know about the bootstrap: resampling in the
undergraduate statistics curriculum. The American Statistician 69(4):371-386.

R. Agarwal et al. (2021). Deep reinforcement learning at the edge of the statistical precipice.
NeurIPS 34 (interquartile mean, bootstrap stratified over tasks, probability of improvement).
"""

from colift.benchmark.statistics.averages import (
    MeanWithMissing,
    interquartile_mean,
    mean_with_missing,
)
from colift.benchmark.statistics.bootstrap import stratified_bootstrap
from colift.benchmark.statistics.estimate import (
    Estimate,
    PairedDifference,
    difference_of_means,
    mean_of,
    paired_difference,
    ratio_of_means,
)
from colift.benchmark.statistics.permutation import (
    holm_correction,
    paired_permutation_p,
    permutation_ps_against,
)
from colift.benchmark.statistics.ranking import decisive, rank_groups
from colift.benchmark.statistics.samples import FloatArray, Interval
from colift.benchmark.statistics.superiority import probability_better, share_better

__all__ = [
    "Estimate",
    "FloatArray",
    "Interval",
    "MeanWithMissing",
    "PairedDifference",
    "decisive",
    "difference_of_means",
    "holm_correction",
    "interquartile_mean",
    "mean_of",
    "mean_with_missing",
    "paired_difference",
    "paired_permutation_p",
    "permutation_ps_against",
    "probability_better",
    "rank_groups",
    "ratio_of_means",
    "share_better",
    "stratified_bootstrap",
]
