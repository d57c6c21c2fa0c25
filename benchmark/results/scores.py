"""The score table: an agent's scores, metric by metric and lift by lift."""

import functools
import math
from array import array
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any, NamedTuple, Self

import msgspec
import numpy as np
from colift.benchmark.episode.loop import Episode
from colift.benchmark.episode.metric import LEADING, gentle, on_boards
from colift.benchmark.execution.runner import Run
from colift.benchmark.statistics import (
    Estimate,
    FloatArray,
    MeanWithMissing,
    PairedDifference,
    Units,
    geometric_ratio,
    log_ratios,
    mean_of,
    mean_with_missing,
    paired_difference,
    probability_better,
)
from colift.benchmark.suites.suite import Suite

Stratum = tuple[str, str]
"""Behaviour and subject."""


@dataclass(frozen=True, kw_only=True)
class ScoreTable:
    """The scores of one agent: metrics x lifts that count, and the stratum of each lift.

    Means, intervals, ranks and the rows of boards are taken from it.
    """

    strata: tuple[Stratum, ...]
    """Behaviour and subject of each lift, in the suite's order."""
    people: tuple[str, ...] = ()
    """The person of each lift, where it is not the subject: see :attr:`.Scenario.person`."""
    values: Mapping[str, Sequence[float]] = field(hash=False)
    """Value of each metric in each lift, NaN where there is none. A stored table has the leading
    metric, and those of :attr:`gentle`."""
    means: Mapping[str, float | None] = field(default_factory=dict, hash=False)
    """Means of the other metrics that boards show; None where no lift has a value. A part of a
    table has none."""
    failures: tuple[str | None, ...] = ()
    """Reason of each failure; None for a lift that did not fail. A stored table has none."""
    session_mm: Sequence[float] = field(default=(), hash=False)
    """RMSE of each lift of the suite [mm], by its place, if it has sessions, of which only the last
    lifts count; empty if all lifts count."""
    gentle: tuple[str, ...] = ()
    """Metrics that show how gentle the agent is, by which others are compared with it; a table that
    was stored before there were such metrics has none."""

    @classmethod
    def of(cls, run: Run) -> Self:
        """Return the scores of a run."""
        return cls.of_lifts(run.suite, zip(run.places, run.episodes, strict=True))

    @classmethod
    def of_lifts(cls, suite: Suite, lifts: Iterable[tuple[int, Episode]]) -> Self:
        """Return the scores of episodes that come with their places, in any order; none is kept."""
        metrics = suite.metrics
        columns = {name: np.full(suite.size, np.nan) for name in metrics}
        reasons: dict[int, str] = {}
        arrived = np.zeros(suite.size, dtype=np.bool_)
        for place, each in lifts:
            arrived[place] = True
            for name, column in columns.items():
                column[place] = each.scores[name]
            if each.failure is not None:
                reasons[place] = each.failure
        places = [int(place) for place in np.flatnonzero(arrived) if suite.counts(int(place))]
        scenarios = [suite.scenarios[place // len(suite.seeds)] for place in places]
        known: dict[Stratum, Stratum] = {}
        strata = ((each.behaviour, each.subject.name) for each in scenarios)
        named = all(each.person == each.subject.name for each in scenarios)
        values = {name: array("d", column[places].tobytes()) for name, column in columns.items()}
        return cls(
            strata=tuple(known.setdefault(each, each) for each in strata),
            people=() if named else tuple(each.person for each in scenarios),
            values=values,
            means={
                each.name: mean_with_missing(values[each.name]).mean for each in on_boards(metrics)
            },
            failures=tuple(map(reasons.get, places)),
            session_mm=tuple(columns[LEADING].tolist()) if suite.session else (),
            gentle=tuple(each.name for each in gentle(metrics)),
        )

    @functools.cached_property
    def units(self) -> Units:
        """The people, each with all of their lifts."""
        behaviours, subjects = zip(*self.strata, strict=True)
        return Units.people(zip(behaviours, self.people or subjects, strict=True))

    @property
    def rmse_mm(self) -> Sequence[float]:
        """RMSE of each lift [mm]."""
        return self.values[LEADING]

    @property
    def lifts_mm(self) -> Sequence[float]:
        """RMSE of each lift of the suite [mm], by its place."""
        return self.session_mm or self.rmse_mm

    def lifts_at(self, places: Sequence[int]) -> Sequence[float]:
        """Return the RMSE of the lifts of a run [mm], by the run's places.

        Without sessions the run and this table have the same lifts.
        """
        return [self.session_mm[each] for each in places] if self.session_mm else self.rmse_mm

    @property
    def mean(self) -> float:
        """Mean RMSE [mm]."""
        return float(np.mean(self.rmse_mm))

    @property
    def failed(self) -> int:
        """Number of lifts that failed."""
        return sum(reason is not None for reason in self.failures)

    def metric(self, name: str) -> MeanWithMissing:
        """Return the mean of a metric over the lifts that have a value."""
        return mean_with_missing(self.values[name])

    @functools.cached_property
    def error(self) -> Estimate:
        """Mean RMSE with its interval [mm]."""
        return mean_of(self.rmse_mm, self.units)

    def estimate(self, name: str) -> Estimate | None:
        """Return the mean of a metric with its interval; None if no lift has a value."""
        values = np.asarray(self.values[name], dtype=np.float64)
        known = np.flatnonzero(~np.isnan(values))
        return mean_of(values[known], self.units.select(known)) if known.size else None

    def select(self, members: Sequence[int]) -> Self:
        """Return the lifts with these indices."""
        return type(self)(
            strata=tuple(self.strata[i] for i in members),
            people=tuple(self.people[i] for i in members if self.people),
            values={name: array("d", (of[i] for i in members)) for name, of in self.values.items()},
            failures=tuple(self.failures[i] for i in members if self.failures),
            gentle=self.gentle,
        )

    def part(self, behaviour: str | None = None, subject: str | None = None) -> Self:
        """Return the lifts of a behaviour and a subject; None is all of them."""
        return self.select(
            [
                i
                for i, (mine, person) in enumerate(self.strata)
                if behaviour in (None, mine) and subject in (None, person)
            ]
        )

    @functools.cached_property
    def by_stratum(self) -> dict[Stratum, Self]:
        """The table of each stratum, in order of appearance."""
        members: dict[Stratum, list[int]] = {}
        for i, key in enumerate(self.strata):
            members.setdefault(key, []).append(i)
        return {key: self.select(some) for key, some in members.items()}

    def against(self, other: "ScoreTable", name: str = LEADING) -> "Paired":
        """Return a metric of this agent and another, in the lifts in which both have a value."""
        one, two = (np.asarray(each.values[name], dtype=np.float64) for each in (self, other))
        if one.shape != two.shape:
            raise ValueError(f"{one.size} lifts against {two.size}: they must be the same lifts")
        known = np.flatnonzero(~np.isnan(one + two))
        return Paired(one[known], two[known], self.units.select(known))

    def stored(self) -> Self:
        """Return what is left of the table when it is stored and read again."""
        values = {name: self.values[name] for name in (LEADING, *self._compared)}
        return type(self)(
            strata=self.strata,
            people=self.people,
            values=values,
            means=self.means,
            session_mm=self.session_mm,
            gentle=self.gentle,
        )

    def plain(self) -> dict[str, Any]:
        """Return what a stored table has, ready for JSON."""
        return {
            "strata": [list(key) for key in self.strata],
            **({"people": list(self.people)} if self.people else {}),
            "rmse_mm": list(self.rmse_mm),
            **({"session_mm": list(self.session_mm)} if self.session_mm else {}),
            "means": dict(self.means),
            "gentle": {
                name: [None if math.isnan(value) else value for value in self.values[name]]
                for name in self._compared
            },
        }

    @property
    def _compared(self) -> tuple[str, ...]:
        """The metrics of :attr:`gentle` that the table has."""
        return tuple(name for name in self.gentle if name in self.values)

    @classmethod
    def read(cls, content: object) -> Self:
        """Return the table that :meth:`plain` has written.

        Raises
        ------
        msgspec.ValidationError
            If it is not such content; the message names the place and the type that it must have.
        ValueError
            If there are not as many errors, people, or values of another metric, as strata.
        """
        kept = msgspec.convert(content, _Stored)
        if len(kept.strata) != len(kept.rmse_mm):
            raise ValueError(
                f"{len(kept.rmse_mm)} errors for the strata of {len(kept.strata)} lifts"
            )
        if kept.people and len(kept.people) != len(kept.strata):
            raise ValueError(f"{len(kept.people)} people for {len(kept.strata)} lifts")
        values = {LEADING: array("d", kept.rmse_mm)}
        for name, lifts in kept.gentle.items():
            if len(lifts) != len(kept.strata):
                raise ValueError(f"{len(lifts)} values of {name} for {len(kept.strata)} lifts")
            values[name] = array("d", (math.nan if each is None else each for each in lifts))
        return cls(
            strata=kept.strata,
            people=kept.people,
            values=values,
            means=kept.means,
            session_mm=kept.session_mm,
            gentle=tuple(kept.gentle),
        )


class _Stored(msgspec.Struct):
    strata: tuple[Stratum, ...]
    rmse_mm: tuple[float, ...]
    means: dict[str, float | None]
    people: tuple[str, ...] = ()
    session_mm: tuple[float, ...] = ()
    gentle: dict[str, tuple[float | None, ...]] = {}


class Paired(NamedTuple):
    """A metric of two agents on the same lifts."""

    one: FloatArray
    other: FloatArray
    units: Units
    """The people of these lifts."""

    @property
    def ratio(self) -> Estimate:
        """Geometric mean of the first divided by the second, over the lifts."""
        return geometric_ratio(*self)

    @property
    def log_ratios(self) -> FloatArray:
        """Logarithm of this ratio in each lift."""
        return log_ratios(self.one, self.other)

    @property
    def difference(self) -> Estimate:
        """Mean of the first minus that of the second."""
        return paired_difference(*self)

    @property
    def probability(self) -> float | None:
        """Probability that the :attr:`ratio` is below 1 with other people; None with one person."""
        return probability_better(self.log_ratios, np.zeros(len(self.one)), self.units)

    def tested(self, p: float) -> PairedDifference:
        """Return the difference with its p value."""
        return PairedDifference.of(*self, p)
