"""Public lifts of a bundle, by behaviour.

A bundle is read only once: it never changes, unless a rescore replaces it by another one.
"""

import csv
import functools
from pathlib import Path

from colift.benchmark.bundle.files import EPISODES, FILES, RESULTS
from colift.benchmark.bundle.table import HUMAN_HUMAN_RMSE
from colift.benchmark.episode.metric import LEADING
from colift.benchmark.results.curve import SessionCurve
from colift.benchmark.results.lifts import ScoredLift
from colift.benchmark.results.parts import Part
from colift.benchmark.results.scores import ScoreTable
from colift.benchmark.results.strata import StratumScore, mean_of_strata
from colift.benchmark.statistics import Estimate
from colift.leaderboard.records.metrics import read_means
from colift.leaderboard.storage.files import read_json


def version(bundle: Path) -> tuple[int, int]:
    """Return what tells a bundle from another one that replaces it."""
    found = (bundle / RESULTS).stat()
    return found.st_ino, found.st_mtime_ns


def stratum_scores(bundle: Path) -> tuple[StratumScore, ...]:
    """Return the means of each stratum of a bundle, in the suite's order."""
    return _stratum_scores(bundle, version(bundle))


@functools.lru_cache(maxsize=8192)
def _stratum_scores(bundle: Path, _: tuple[int, int]) -> tuple[StratumScore, ...]:
    results = read_json(bundle / RESULTS)
    return tuple(
        StratumScore.read(group, read_means(group, results["suite"], group["episodes"]))
        for group in results["groups"]
    )


def session_of(bundle: Path) -> SessionCurve | None:
    """Return the errors lift by lift of a bundle; None if its lifts are independent."""
    content = read_json(bundle / RESULTS).get("session")
    return None if content is None else SessionCurve.read(content)


def public_lifts(bundle: Path) -> tuple[ScoredLift, ...]:
    """Return the lifts of a bundle, in the suite's order; none if it has only results."""
    return _public_lifts(bundle, version(bundle))


@functools.lru_cache(maxsize=64)
def _public_lifts(bundle: Path, _: tuple[int, int]) -> tuple[ScoredLift, ...]:
    if not (bundle / EPISODES).is_file():
        return ()
    with (bundle / EPISODES).open(newline="", encoding="utf-8") as file:
        return tuple(
            ScoredLift(
                behaviour=row["behaviour"],
                subject=row["subject"],
                seed=int(row["seed"]),
                rmse_mm=float(row["rmse_mm"]),
                human_human_mm=float(row[HUMAN_HUMAN_RMSE]) if HUMAN_HUMAN_RMSE in row else None,
                failure=row["failure"] or None,
            )
            for row in csv.DictReader(file)
        )


def public_scores(bundle: Path) -> ScoreTable:
    """Return the RMSE of the lifts of a bundle that count, in the suite's order."""
    lifts, session = public_lifts(bundle), session_of(bundle)
    if session is not None:
        length = len(session.rmse_mm)
        lifts = tuple(
            lift for i, lift in enumerate(lifts) if i % length >= length - session.counted
        )
    return ScoreTable(
        strata=tuple((lift.behaviour, lift.subject) for lift in lifts),
        values={LEADING: tuple(lift.rmse_mm for lift in lifts)},
    )


def is_whole(bundle: Path | None) -> bool:
    """Return whether a bundle can be verified; those of practice rows are incomplete."""
    return bundle is not None and all((bundle / name).is_file() for name in FILES)


def part_estimate(bundle: Path, part: Part) -> Estimate:
    """Return the mean RMSE [mm] of a bundle over a part, with its 95 % interval.

    There is no interval if the bundle has only results, or the part is of one person.
    """
    return _part_estimate(bundle, version(bundle), part)


@functools.lru_cache(maxsize=4096)
def _part_estimate(bundle: Path, _: tuple[int, int], part: Part) -> Estimate:
    scores = public_scores(bundle).part(part.behaviour)
    if scores.strata:
        return scores.error
    return known(mean_of_strata(part.of(stratum_scores(bundle))).mean or 0.0)


def known(mean: float) -> Estimate:
    """Return a mean without a known interval."""
    return Estimate(mean=mean, ci95=None)
