"""A criterion of admission: the ratio of two players' errors on the same lifts."""

import math

import numpy as np
from colift.benchmark.admission.criteria import Criterion
from colift.benchmark.admission.jackknife import ratio_interval
from colift.benchmark.admission.played import Played


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
    if the ratio is within the limit and, with ``beyond``, the interval has no 1 in it.
    """
    logs = np.log(played.part((one, other)).errors)
    by_person = (logs[0] - logs[1]).mean(axis=-1)
    figure = math.exp(by_person.mean())
    left = [math.exp(np.delete(by_person, person).mean()) for person in range(len(by_person))]
    low, high = ratio_interval(figure, left)
    first, second = (played.means[name] for name in (one, other))
    within = (least is None or (figure >= least and (low > 1.0 or not beyond))) and (
        most is None or (figure <= most and (high < 1.0 or not beyond))
    )
    return Criterion(
        letter=stated.letter,
        claim=stated.claim,
        what=stated.what,
        bar=stated.bar,
        detail=f"{one} {first:.2f} mm, {other} {second:.2f} mm",
        figure=figure,
        ci95=(low, high),
        passed=within,
    )
