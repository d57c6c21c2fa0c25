"""What a bundle says of the public run, cell by cell and lift by lift.

A bundle is written once and never changed, so it is read once.
"""

import csv
import functools
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from ...benchmark.bundle.files import EPISODES, FILES, RESULTS
from ..files import read_json


@dataclass(frozen=True, kw_only=True)
class CellScore:
    """Means over the public lifts of one behaviour with one subject."""

    behaviour: str
    subject: str
    episodes: int
    failed: int
    rmse_mm: float
    team_rmse_mm: float | None
    """The human-human team's."""
    sparc: float | None
    """Over the lifts that have one."""
    sparc_missing: int
    """Lifts without smoothness."""
    human_force_n: float | None


@dataclass(frozen=True, kw_only=True)
class PublicLift:
    """One public lift."""

    behaviour: str
    subject: str
    seed: int
    rmse_mm: float
    failure: str | None
    """Why it failed, in the policy's own words where it is the policy's."""


@functools.lru_cache(maxsize=8192)
def cell_scores(bundle: Path) -> tuple[CellScore, ...]:
    """Return the means of each cell of a bundle, in the suite's order."""
    return tuple(_cell(group) for group in read_json(bundle / RESULTS)["groups"])


@functools.lru_cache(maxsize=64)
def public_lifts(bundle: Path) -> tuple[PublicLift, ...]:
    """Return the lifts of a bundle, in the suite's order; none if only its results are there."""
    if not (bundle / EPISODES).is_file():
        return ()
    with (bundle / EPISODES).open(newline="", encoding="utf-8") as file:
        return tuple(
            PublicLift(
                behaviour=row["behaviour"],
                subject=row["subject"],
                seed=int(row["seed"]),
                rmse_mm=float(row["rmse_mm"]),
                failure=row["failure"] or None,
            )
            for row in csv.DictReader(file)
        )


def is_whole(bundle: Path | None) -> bool:
    """Return whether all of a bundle is there, to be verified; of shipped ones some is not."""
    return bundle is not None and all((bundle / name).is_file() for name in FILES)


def _cell(group: dict[str, Any]) -> CellScore:
    return CellScore(
        behaviour=group["behaviour"],
        subject=group["subject"],
        episodes=group["episodes"],
        failed=group["failed"],
        rmse_mm=group["rmse_mm"]["mean"],
        team_rmse_mm=group["human_human_rmse_mm"]["mean"],
        sparc=group["sparc"]["mean"],
        sparc_missing=group["sparc"]["missing"],
        human_force_n=group["human_force_n"]["mean"],
    )
