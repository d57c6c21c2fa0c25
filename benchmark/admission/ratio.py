"""A criterion of admission: the ratio of two players' errors on the same lifts."""

import math
from dataclasses import replace

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
    least: float = 0.0,
    most: float = math.inf,
) -> Criterion:
    """Return a criterion of the ratio of two players' errors, with its interval over people.

    The ratio is the geometric mean over lifts, like ``vs_human``: errors with the quickest
    behaviours are three times those with others, and would be most of a mean. The criterion passes
    if the whole interval is within the limit; it is undecided if one person decides that.
    """
    logs = np.log(played.part((one, other)).errors)
    by_person = (logs[0] - logs[1]).mean(axis=-1)
    figure, ci95, passed = _judged(by_person, least, most)
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
            if _judged(np.delete(by_person, i), least, most)[2] is not passed
        ),
    )


def _judged(by_person: FloatArray, least: float, most: float) -> tuple[float, Interval, bool]:
    """Return ratio, interval and result, of the mean logarithm with each person."""
    figure = math.exp(by_person.mean())
    left = [math.exp(np.delete(by_person, i).mean()) for i in range(len(by_person))]
    low, high = ratio_interval(figure, left)
    return figure, (low, high), least <= low and high <= most
