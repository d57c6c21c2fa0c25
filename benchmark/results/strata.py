"""Means of a run in each stratum, as bundles and boards publish them, and over some strata."""

import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import asdict, dataclass
from typing import Any, Final, Self

import numpy as np
from colift.benchmark.episode.metric import LEADING
from colift.benchmark.results.scores import ScoreTable, Stratum
from colift.benchmark.statistics import MeanWithMissing


@dataclass(frozen=True, kw_only=True)
class StratumScore:
    """Means over the lifts of one behaviour with one subject."""

    behaviour: str
    subject: str
    episodes: int
    failed: int
    rmse_mm: float
    human_human_rmse_mm: float | None
    """Two people's; None without this baseline."""
    vs_human: float | None
    """Geometric mean of the ratio of the two, lift by lift; None without this baseline."""
    metrics: Mapping[str, MeanWithMissing]
    """The other metrics by name."""

    def plain(self) -> dict[str, Any]:
        """Return the scores as a group of ``results.json``."""
        return {
            "behaviour": self.behaviour,
            "subject": self.subject,
            "episodes": self.episodes,
            "failed": self.failed,
            LEADING: {"mean": self.rmse_mm, "missing": 0},
            **plain_means(self.metrics),
            "human_human_rmse_mm": {"mean": self.human_human_rmse_mm},
            "vs_human": {"mean": self.vs_human},
        }

    @classmethod
    def read(cls, group: Mapping[str, Any], metrics: Mapping[str, MeanWithMissing]) -> Self:
        """Return the scores that :meth:`plain` has written, with some of their metrics."""
        kept = {name: group[name] for name in ("behaviour", "subject", "episodes", "failed")}
        return cls(
            **kept,
            rmse_mm=group[LEADING]["mean"],
            human_human_rmse_mm=group["human_human_rmse_mm"]["mean"],
            vs_human=group["vs_human"]["mean"],
            metrics=metrics,
        )


def plain_means(metrics: Mapping[str, MeanWithMissing]) -> dict[str, Any]:
    """Return means by name, ready for JSON."""
    return {name: asdict(mean) for name, mean in metrics.items()}


def stratum_scores(scores: ScoreTable, human_human: ScoreTable | None) -> tuple[StratumScore, ...]:
    """Return the means of each stratum, in order of appearance.

    ``human_human`` is of two people, if it is known.
    """
    people = {} if human_human is None else human_human.by_stratum
    return tuple(
        _stratum_score(key, some, people.get(key)) for key, some in scores.by_stratum.items()
    )


def _stratum_score(key: Stratum, some: ScoreTable, people: ScoreTable | None) -> StratumScore:
    whole = people is not None and len(people.strata) == len(some.strata)
    behaviour, subject = key
    return StratumScore(
        behaviour=behaviour,
        subject=subject,
        episodes=len(some.strata),
        failed=some.failed,
        rmse_mm=some.mean,
        human_human_rmse_mm=None if people is None else people.mean,
        vs_human=some.against(people).ratio.mean if people is not None and whole else None,
        metrics={name: some.metric(name) for name in some.values if name != LEADING},
    )


def mean_of_strata(strata: Iterable[StratumScore], name: str = LEADING) -> MeanWithMissing:
    """Return the mean of a metric over the lifts of some strata that have a value."""
    some = list(strata)
    if name == LEADING:
        return _pooled(
            [(MeanWithMissing(mean=each.rmse_mm, missing=0), each.episodes) for each in some]
        )
    return _pooled([(each.metrics[name], each.episodes) for each in some])


@dataclass(frozen=True, kw_only=True)
class Spread:
    """How the error differs from person to person: order statistics of the people's means [mm]."""

    people: int
    """Number of people."""
    best: float
    lower: float
    """Lower quartile."""
    median: float
    upper: float
    """Upper quartile."""
    worst: float
    worst_person: str
    better: int | None
    """Number of people with whom the mean is below two people's; None without it."""


def spread_over_people(strata: Iterable[StratumScore]) -> Spread:
    """Return the spread of the leading metric over the people of some strata, at least one.

    Quartiles are interpolated linearly between order statistics.
    """
    mine: dict[str, list[StratumScore]] = {}
    for each in strata:
        mine.setdefault(each.subject, []).append(each)
    means = {person: mean_of_strata(some).mean or 0.0 for person, some in mine.items()}
    humans = {person: human_human_mean(some) for person, some in mine.items()}
    best, lower, median, upper, worst = np.quantile([*means.values()], QUARTILES).tolist()
    better = [means[person] < mean for person, mean in humans.items() if mean is not None]
    return Spread(
        people=len(means),
        best=best,
        lower=lower,
        median=median,
        upper=upper,
        worst=worst,
        worst_person=max(means, key=means.__getitem__),
        better=sum(better) if len(better) == len(means) else None,
    )


QUARTILES: Final = (0.0, 0.25, 0.5, 0.75, 1.0)


def human_human_mean(strata: Iterable[StratumScore]) -> float | None:
    """Return two people's mean RMSE [mm], if it is known in all of some strata."""
    some = [(each.human_human_rmse_mm, each.episodes) for each in strata]
    if any(mean is None for mean, _ in some):
        return None
    return _pooled([(MeanWithMissing(mean=mean, missing=0), lifts) for mean, lifts in some]).mean


def vs_human_mean(strata: Iterable[StratumScore]) -> float | None:
    """Return the geometric mean ratio to two people over the lifts of some strata, if known."""
    some = [(each.vs_human, each.episodes) for each in strata]
    logs = [(math.log(ratio), lifts) for ratio, lifts in some if ratio is not None]
    if not logs or len(logs) < len(some):
        return None
    return math.exp(sum(log * lifts for log, lifts in logs) / sum(lifts for _, lifts in logs))


def _pooled(means: Sequence[tuple[MeanWithMissing, int]]) -> MeanWithMissing:
    """Return the mean of means, weighted by their numbers of lifts with a value."""
    known = [(each.mean, lifts - each.missing) for each, lifts in means if each.mean is not None]
    count = sum(lifts for _, lifts in known)
    return MeanWithMissing(
        mean=sum(mean * lifts for mean, lifts in known) / count if count else None,
        missing=sum(each.missing for each, _ in means),
    )
