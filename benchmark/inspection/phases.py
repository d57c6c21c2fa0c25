"""The phases of lifts: how much of the error arises while the person rises, holds or lowers."""

import itertools
import math
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from colift.benchmark.episode.trace import Series
from colift.benchmark.inspection.moments import Events


class PhaseError(NamedTuple):
    """The error in one phase of one lift."""

    name: str
    """Name of the event of the plan that begins it."""
    squares: float
    """Sum of the squared errors [m2]."""
    frames: int


@dataclass(frozen=True, kw_only=True)
class PhaseScore:
    """The error of a policy in the phases of one name, over all lifts."""

    name: str
    time_share: float
    """Share of the frames."""
    error_share: float
    """Share of the sum of the squared errors."""
    rmse_mm: float
    """Root mean square of the error that pictures show [mm]."""
    human_human_mm: float | None
    """That of two people [mm]; None if they have no such frame."""


def phase_errors(events: Events, error: Series) -> Iterator[PhaseError]:
    """Yield the error in each phase of a lift.

    Parameters
    ----------
    events
        The events of the person's plan, which begin the phases; see :func:`.events_of`.
    error
        The error in each frame [m]; frames that a failure cut off are in no phase.
    """
    firsts = [*(first for _, first in events), len(error)]
    for (name, _), (first, stop) in zip(events, itertools.pairwise(firsts), strict=True):
        some = error[first:stop]
        yield PhaseError(name, float(np.square(some).sum()), len(some))


def phase_scores(
    mine: Iterable[PhaseError], human_human: Iterable[PhaseError]
) -> tuple[PhaseScore, ...]:
    """Return the phases of a policy's lifts beside two people's, the largest error share first."""
    pooled, people = _pooled(mine), _pooled(human_human)
    if not pooled:
        return ()
    squares, frames = (math.fsum(sums) for sums in zip(*pooled.values(), strict=True))
    found = [
        PhaseScore(
            name=name,
            time_share=time / frames,
            error_share=error / squares if squares else 0.0,
            rmse_mm=1000 * math.sqrt(error / time),
            human_human_mm=_rmse_mm(people.get(name)),
        )
        for name, (error, time) in pooled.items()
    ]
    return tuple(sorted(found, key=lambda each: -each.error_share))


def _pooled(errors: Iterable[PhaseError]) -> dict[str, tuple[float, int]]:
    """Return the sums of the squares and of the frames by the name of the phase."""
    found: dict[str, list[PhaseError]] = {}
    for each in errors:
        if each.frames:
            found.setdefault(each.name, []).append(each)
    return {
        name: (math.fsum(each.squares for each in some), sum(each.frames for each in some))
        for name, some in found.items()
    }


def _rmse_mm(sums: tuple[float, int] | None) -> float | None:
    return None if sums is None else 1000 * math.sqrt(sums[0] / sums[1])
