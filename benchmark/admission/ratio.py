"""A criterion of admission: the ratio of two players' errors on the same lifts."""

import math
from dataclasses import dataclass, replace

import numpy as np
from colift.benchmark.admission.criteria import Criterion
from colift.benchmark.admission.jackknife import ratio_interval
from colift.benchmark.admission.played import LEAST_PEOPLE, Played
from colift.benchmark.statistics import FloatArray, Interval


def ratio_criterion(
    played: Played,
    one: str,
    other: str,
    stated: Criterion,
    *,
    least: float | None = None,
    most: float | None = None,
    beyond: bool = True,
) -> Criterion:
    """Return a criterion of the ratio of two players' errors, with its interval over people.

    The ratio is the geometric mean over lifts, like ``vs_human``: errors with the quickest
    behaviours are three times those with others, and would be most of a mean. The criterion passes
    if the ratio is within the limit and, with ``beyond``, the interval has no 1 in it; it is
    undecided if one person decides that.
    """
    logs = np.log(played.part((one, other)).errors)
    by_person = (logs[0] - logs[1]).mean(axis=-1)
    limits = _Limits(least=least, most=most, beyond=beyond)
    figure, ci95, passed = limits.judge(by_person)
    people = played.people if len(by_person) > LEAST_PEOPLE else ()
    first, second = (played.means[name] for name in (one, other))
    return replace(
        stated,
        detail=f"{one} {first:.2f} mm, {other} {second:.2f} mm",
        figure=figure,
        ci95=ci95,
        passed=passed,
        hangs_on=tuple(
            person
            for i, person in enumerate(people)
            if limits.judge(np.delete(by_person, i))[2] is not passed
        ),
    )


@dataclass(frozen=True, kw_only=True)
class _Limits:
    """What a ratio must be."""

    least: float | None
    most: float | None
    beyond: bool

    def judge(self, by_person: FloatArray) -> tuple[float, Interval, bool]:
        """Return ratio, interval and verdict, of the mean logarithm with each person."""
        figure = math.exp(by_person.mean())
        left = [math.exp(np.delete(by_person, i).mean()) for i in range(len(by_person))]
        low, high = ratio_interval(figure, left)
        enough = self.least is None or (figure >= self.least and (low > 1.0 or not self.beyond))
        little = self.most is None or (figure <= self.most and (high < 1.0 or not self.beyond))
        return figure, (low, high), enough and little
