"""The paper's numbers (Thobbi, Gu, Sheng 2011, section IV), and Table I with ours next to them."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Final

import numpy as np
from colift.benchmark.episode.loop import Episode
from colift.benchmark.execution.runner import Run
from colift.benchmark.statistics import (
    Estimate,
    Interval,
    Units,
    mean_of,
    paired_difference,
    paired_permutation_p,
    ratio_of_means,
)
from numpy.typing import NDArray

WITHOUT_PREDICTION: Final = {"S1": 19.139, "S2": 23.567, "S3": 24.872, "S4": 20.085, "S5": 22.432}
"""Table I: average RMSE of each subject with the reactive controller alone [mm]."""

WITH_PREDICTION: Final = {"S1": 12.967, "S2": 16.591, "S3": 18.418, "S4": 15.391, "S5": 17.684}
"""Table I: average RMSE of each subject with the whole framework [mm]."""

HUMAN_HUMAN_RMSE: Final = 6.531
"""RMSE of the paper's single pair of people [mm] (section V.A)."""

MEDIAN_ITERATIONS: Final = 36
"""Median number of iterations until Q-learning converged (section IV.A)."""

LONGEST_ITERATIONS: Final = 62
"""Iterations of the longest of the ten trials."""

TRIALS: Final = 10
"""Number of learning trials."""

FORGETTING: Final = 0.45
"""Forgetting factor that was found good (section IV.C)."""

FORGETTING_FACTORS: Final = (0.05, 0.25, 0.45, 0.65, 0.85, 0.95)
"""Forgetting factors to compare; those in the paper's figure are not all legible, these span its
range."""


@dataclass(frozen=True, kw_only=True)
class Reproduction:
    """One number of the paper and ours."""

    paper: float
    mean: float
    ci95: Interval
    """95 % confidence interval of ``mean``, for other lifts of these subjects: they stand for the
    paper's five, and are no sample of people."""

    @property
    def ratio(self) -> float:
        """Ours / the paper's."""
        return self.mean / self.paper


@dataclass(frozen=True, kw_only=True)
class SubjectRow:
    """One subject, or all of them."""

    subject: str
    reactive: Reproduction
    """RMSE without prediction [mm]."""
    blend: Reproduction
    """RMSE with prediction [mm]."""
    difference: Estimate
    """With minus without, over the same lifts [mm]."""
    p: float
    """p value for the hypothesis that prediction changes nothing, by sign flips over the lifts."""


@dataclass(frozen=True, kw_only=True)
class TableOne:
    """The paper's Table I with ours next to it."""

    rows: tuple[SubjectRow, ...]
    mean: SubjectRow
    """All subjects together."""
    ratio: Reproduction
    """Mean with prediction / mean without."""
    human_human: Reproduction
    """RMSE of two people [mm] (section V.A)."""
    lifts: int
    """Lifts in each of our cells."""


def table_one(reactive: Run, blend: Run, human_human: Run) -> TableOne:
    """Return Table I from runs on the same suite, one scenario per subject."""
    subjects = [scenario.subject.name for scenario in blend.suite.scenarios]
    strata = [episode.subject for episode in blend.episodes]
    without, with_it = errors(reactive.episodes), errors(blend.episodes)
    paper_without = _mean(WITHOUT_PREDICTION, subjects)
    paper_with = _mean(WITH_PREDICTION, subjects)
    ratio = ratio_of_means(with_it, without, Units.episodes(strata))

    def row(name: str, papers: tuple[float, float], members: Sequence[str]) -> SubjectRow:
        mask = np.isin(strata, members)
        lifts = Units.episodes(subject for subject in strata if subject in members)
        return SubjectRow(
            subject=name,
            reactive=_cell(papers[0], without[mask], lifts),
            blend=_cell(papers[1], with_it[mask], lifts),
            difference=paired_difference(with_it[mask], without[mask], lifts),
            p=paired_permutation_p(with_it[mask], without[mask], lifts),
        )

    return TableOne(
        rows=tuple(
            row(subject, (WITHOUT_PREDICTION[subject], WITH_PREDICTION[subject]), [subject])
            for subject in subjects
        ),
        mean=row("mean", (paper_without, paper_with), subjects),
        ratio=Reproduction(paper=paper_with / paper_without, mean=ratio.mean, ci95=ratio.ends),
        human_human=_cell(HUMAN_HUMAN_RMSE, errors(human_human.episodes), Units.episodes(strata)),
        lifts=len(blend.suite.seeds),
    )


def errors(episodes: Sequence[Episode]) -> NDArray[np.float64]:
    """Return the RMSE of each episode [mm]."""
    return np.array([episode.scores["rmse_mm"] for episode in episodes])


def single_lifts(values: NDArray[np.float64]) -> Units:
    """Return the lifts of a claim as units of their own.

    The subjects stand for the paper's five: a claim holds for other lifts of these, not of others.
    """
    return Units.episodes(["all"] * len(values))


def _mean(column: dict[str, float], subjects: Sequence[str]) -> float:
    return float(np.mean([column[subject] for subject in subjects]))


def _cell(paper: float, values: NDArray[np.float64], lifts: Units) -> Reproduction:
    found = mean_of(values, lifts)
    return Reproduction(paper=paper, mean=found.mean, ci95=found.ends)
