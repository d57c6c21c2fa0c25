"""The mark of policies that are rougher than two people."""

from collections.abc import Mapping, Sequence
from typing import Final

from colift.benchmark.episode.metric import Metric, gentle
from colift.benchmark.results.scores import ScoreTable

ROUGHER: Final = "rougher than two people"
"""The mark beside a rank."""

SIGN: Final = "‡"
"""The mark where there is no room for words."""

MEANING: Final = (
    "Rougher than two people: by a measure of force or of smoothness, worse than two people on the "
    "same lifts, beyond the 95 % interval of the difference."
)
"""Its meaning in one sentence."""


def rougher(
    policy: ScoreTable, people: ScoreTable, metrics: Mapping[str, Metric]
) -> tuple[str, ...] | None:
    """Return the metrics by which a policy is rougher than two people; none if it is not.

    Those are the metrics that show how gentle an agent is (:attr:`.Metric.gentle`), by which it is
    worse on the lifts in which both have a value, beyond the 95 % interval of the difference.

    Parameters
    ----------
    policy
        Scores of the policy.
    people
        Scores of two people on the same lifts.
    metrics
        The metrics of their task.

    Returns
    -------
    tuple
        Names of metrics, none with a single person; None if these values of the baseline are not
        known.
    """
    compared = gentle(metrics)
    if any(each.name not in people.values for each in compared):
        return None
    return tuple(each.name for each in compared if _worse(policy, people, each))


def _worse(policy: ScoreTable, people: ScoreTable, metric: Metric) -> bool:
    paired = policy.against(people, metric.name)
    if not len(paired.one):
        return False
    interval = paired.difference.ci95
    if interval is None:
        return False
    low, high = interval
    return low > 0.0 if metric.better == "less" else high < 0.0


def by_which(names: Sequence[str], metrics: Mapping[str, Metric]) -> str:
    """Return the metrics by which a policy is rougher, in words; a newer one by its name."""
    nouns = [metrics[name].noun if name in metrics else name for name in names]
    *first, last = nouns
    return f"{', '.join(first)} and {last}" if first else last
