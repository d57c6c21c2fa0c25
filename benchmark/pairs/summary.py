"""The measures of recorded pairs, averaged over lifts, beside those of the simulated two people.

A mean has up to two intervals. The one over lifts holds for further lifts of the same pairs, and
says nothing about other pairs. The one over pairs holds for other pairs; it needs two or more,
which the file has to name.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from colift.benchmark.pairs.coordination import Coordination, coordination
from colift.benchmark.pairs.recorded import RecordedPairs
from colift.benchmark.pairs.simulated import SimulatedPairs
from colift.benchmark.statistics import Estimate, FloatArray, Units, mean_of, paired_difference
from numpy.typing import NDArray

Mask = NDArray[np.bool_]


@dataclass(frozen=True, kw_only=True)
class Averaged:
    """A measure, averaged over the lifts that have it."""

    recorded: Estimate
    """Mean over the recorded lifts, with its interval over lifts."""
    over_pairs: Estimate | None
    """The same with its interval over pairs; None if the file names fewer than two."""
    missing: int
    """Recorded lifts without this measure."""
    simulated: Estimate | None
    """Mean over the simulated lifts, with its interval over lifts; None if there are none."""
    difference: Estimate | None
    """Recorded minus simulated on the same lifts, with its interval over pairs, or over lifts
    without named pairs; None if there are no simulated lifts."""


@dataclass(frozen=True, kw_only=True, eq=False)
class PairsSummary:
    """The measures of the pairs of a file."""

    source: str
    """Name of the file."""
    lifts: Mapping[str, Coordination]
    """The measures of each recorded lift, by its trial."""
    pairs: Mapping[str, str]
    """The pair of each lift, empty if the file names none."""
    without: tuple[str, ...]
    """Trials without a far end."""
    simulated: SimulatedPairs
    averages: Mapping[str, Averaged]
    """The measures that at least one lift has, by name."""

    @property
    def people(self) -> int:
        """Number of pairs that the file names; 0 if it does not name that of every lift."""
        return len({*self.pairs.values()}) if all(self.pairs.values()) else 0


def summarise_pairs(pairs: RecordedPairs, source: str, simulated: SimulatedPairs) -> PairsSummary:
    """Return the measures of recorded pairs beside those of the simulated two people."""
    lifts = {lift.name: coordination(lift.ends) for lift in pairs.lifts}
    names = [lift.pair for lift in pairs.lifts]
    recorded = [each.values() for each in lifts.values()]
    played = [simulated.lifts[name].values() if name in simulated.lifts else {} for name in lifts]
    measures = dict.fromkeys(name for values in recorded for name in values)
    averages = {
        measure: _averaged(_column(recorded, measure), _column(played, measure), names)
        for measure in measures
        if not np.isnan(_column(recorded, measure)).all()
    }
    return PairsSummary(
        source=source,
        lifts=lifts,
        pairs=dict(zip(lifts, names, strict=True)),
        without=pairs.without,
        simulated=simulated,
        averages=averages,
    )


def _column(lifts: Sequence[Mapping[str, float]], measure: str) -> FloatArray:
    """Return a measure of each lift, NaN where there is none."""
    return np.array([values.get(measure, np.nan) for values in lifts])


def _averaged(recorded: FloatArray, simulated: FloatArray, pairs: Sequence[str]) -> Averaged:
    """Return the averages of a measure of n lifts, NaN where there is none."""
    there, both = ~np.isnan(recorded), ~np.isnan(recorded) & ~np.isnan(simulated)
    other = over_pairs(pairs, there)
    compared = over_pairs(pairs, both) or over_lifts(pairs, both)
    return Averaged(
        recorded=mean_of(recorded[there], over_lifts(pairs, there)),
        over_pairs=None if other is None else mean_of(recorded[there], other),
        missing=int((~there).sum()),
        simulated=mean_of(simulated[both], over_lifts(pairs, both)) if both.any() else None,
        difference=(
            paired_difference(recorded[both], simulated[both], compared) if both.any() else None
        ),
    )


def over_lifts(pairs: Sequence[str], some: Mask) -> Units:
    """Return some lifts as units, in groups by their pairs."""
    return Units.episodes(pair for pair, there in zip(pairs, some, strict=True) if there)


def over_pairs(pairs: Sequence[str], some: Mask) -> Units | None:
    """Return the pairs of some lifts as units; None if fewer than two are named."""
    names = [pair for pair, there in zip(pairs, some, strict=True) if there]
    if not all(names) or len({*names}) < 2:
        return None
    return Units.people(("", name) for name in names)
