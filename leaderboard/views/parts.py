"""A policy's public lifts in parts: all, each behaviour, each subject, each cell."""

import functools
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from ...benchmark.comparison.standing import Estimate
from ...benchmark.statistics import stratified_bootstrap
from .lifts import CellScore, PublicLift, cell_scores, public_lifts


@dataclass(frozen=True, kw_only=True)
class Part:
    """Some of the public lifts."""

    behaviour: str | None
    """None: all of them."""
    subject: str | None
    """None: all of them."""

    def has(self, lift: PublicLift | CellScore) -> bool:
        """Whether a lift, or a cell, belongs to it."""
        return self.behaviour in (None, lift.behaviour) and self.subject in (None, lift.subject)

    @property
    def whole(self) -> bool:
        """Whether it is all lifts."""
        return self.behaviour is None and self.subject is None

    @property
    def of_subject(self) -> bool:
        """Whether it is all lifts with a subject."""
        return self.behaviour is None and self.subject is not None


def parts_of(cells: Sequence[CellScore]) -> Iterator[Part]:
    """Yield all lifts, then each behaviour followed by its cells, then each subject."""
    yield Part(behaviour=None, subject=None)
    for behaviour in dict.fromkeys(cell.behaviour for cell in cells):
        yield Part(behaviour=behaviour, subject=None)
        mine = [cell.subject for cell in cells if cell.behaviour == behaviour]
        yield from (Part(behaviour=behaviour, subject=subject) for subject in mine)
    for subject in dict.fromkeys(cell.subject for cell in cells):
        yield Part(behaviour=None, subject=subject)


@functools.lru_cache(maxsize=4096)
def estimate(bundle: Path, part: Part) -> Estimate:
    """Return the mean RMSE [mm] of a bundle over a part, with its 95 % interval.

    It has no width if only the bundle's results are there.
    """
    lifts = [lift for lift in public_lifts(bundle) if part.has(lift)]
    if not lifts:
        return known(mean_rmse(cell_scores(bundle), part) or 0.0)
    values = [lift.rmse_mm for lift in lifts]
    interval = stratified_bootstrap(values, [(lift.behaviour, lift.subject) for lift in lifts])
    return Estimate(mean=float(np.mean(values)), ci95=interval)


def known(mean: float) -> Estimate:
    """Return a mean whose interval is not known."""
    return Estimate(mean=mean, ci95=(mean, mean))


def mean_rmse(cells: Sequence[CellScore], part: Part) -> float | None:
    """Return a policy's mean RMSE [mm] over a part; None if nothing is known of it."""
    some = [cell for cell in cells if part.has(cell)]
    lifts = sum(cell.episodes for cell in some)
    return sum(cell.episodes * cell.rmse_mm for cell in some) / lifts if some else None


def team_rmse(cells: Sequence[CellScore], part: Part | None = None) -> float | None:
    """Return the human-human team's mean RMSE [mm] over a part, if it is known in all of it."""
    some = [cell for cell in cells if part is None or part.has(cell)]
    told = [(cell.episodes, cell.team_rmse_mm) for cell in some if cell.team_rmse_mm is not None]
    if not told or len(told) < len(some):
        return None
    return sum(episodes * rmse for episodes, rmse in told) / sum(episodes for episodes, _ in told)
