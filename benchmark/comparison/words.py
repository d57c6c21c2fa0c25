"""The words of a comparison: what its table, picture and page say in sentences."""

from collections.abc import Sequence
from typing import Final

from ...agents.actions import HAND_SPEED
from ..episode.level_metrics import MOSTLY_CLIPPED
from ..results.baselines import HUMAN_HUMAN_LABEL
from .comparison import Comparison
from .standing import Scope

SURE: Final = 0.975
"""Probability above which the 95 % interval of a difference leaves zero out."""

HOW_TO_READ: Final = (
    "RMSE is how far apart in height the two ends of the table are, over the whole lift: smaller "
    "is more level. A lift that failed counts 250 mm from the failure on.",
    "Policies of the same rank cannot be told from the first of that rank (paired sign flips, "
    "Holm-corrected for the policies behind it, 5 %).",
    "The human-human baseline is two simulated people on the same lifts. vs_human is the RMSE over "
    "theirs: 1 is as level as a human partner, less is better.",
    "SPARC is the smoothness of the robot's end over the human's strokes: closer to 0 is smoother. "
    "A robot that does not move along has none, and counts as least smooth.",
    "Intervals are 95 %, by a bootstrap over the seeds within each behaviour and subject: how far "
    "other lifts of these people would move the number.",
)


PICTURE_AXIS: Final = "← more level · RMSE of the height difference, mm"

PICTURE_CAPTION: Final = (
    "The higher and the further left, the better. Bars are 95 % intervals. The line joins the "
    "policies than which no other is, by its means, both more level and smoother; the diamond is "
    f"the {HUMAN_HUMAN_LABEL}, a square is a bound: no policy, but how far one might come."
)

RANKS_CAPTION: Final = (
    "Small: 95 % intervals; under the median time of a step, its 99th percentile. Policies of one "
    "rank cannot be told from the first of them."
)

AGAINST_CAPTION: Final = (
    "How far each policy is behind the best on the same lifts, with the 95 % interval; p of no "
    "difference, Holm-corrected; the share of the lifts in which it is better than the best; and "
    f"the probability that its mean error on such lifts is below the {HUMAN_HUMAN_LABEL}'s."
)


def title(comparison: Comparison) -> str:
    """Return what is compared, in one line."""
    return f"{len(comparison.contest.entries)} policies on {comparison.contest.suite.name}"


def picture_title(comparison: Comparison) -> str:
    """Return the title of the picture, with a line on how to read it."""
    return (
        f"How level and how smooth: {title(comparison)}\n"
        f"Means over {comparison.overall.episodes} lifts, with 95 % intervals. "
        "Orange: no other policy is both more level and smoother."
        + (" Squares: bounds." if comparison.contest.bounds else "")
    )


def verdict(comparison: Comparison) -> str:
    """Return who is the most level, who cannot be told from it, and where it beats two people."""
    overall = comparison.overall
    best, *others = overall.standings
    told = (
        f"{best.name} is the most level: {best.rmse_mm.mean:.1f} mm, "
        f"{best.vs_human.mean:.2f} times the {HUMAN_HUMAN_LABEL}'s "
        f"{overall.human_human_rmse_mm.mean:.1f} mm."
    )
    equals = [standing.name for standing in others if standing.rank == best.rank]
    if not overall.decisive:
        told += f" But {overall.episodes} lifts are too few to tell policies apart."
    elif equals:
        told += f" {_listed(equals)} cannot be told from it."
    if best.better_than_human > SURE:
        return f"{told} It is more level than two people."
    won = [
        scope.name
        for scope in comparison.behaviours
        for standing in scope.standings
        if standing.name == best.name and standing.better_than_human > SURE
    ]
    return f"{told} On {_listed(won)} it is more level than two people." if won else told


def failures(comparison: Comparison) -> list[str]:
    """Return a sentence for each policy that failed in a lift."""
    told = []
    for entry in comparison.contest.entries:
        reasons = [failure for failure in entry.failures if failure is not None]
        if reasons:
            told.append(
                f"{entry.name}: {len(reasons)} of {len(entry.failures)} lifts failed and count as "
                f"worst; the first: {reasons[0]}"
            )
    return told


def oddities(comparison: Comparison) -> list[str]:
    """Return a sentence for each policy whose actions hardly are in metres."""
    return [
        f"{standing.name}: {100 * standing.clipped:.0f} % of its actions were cut to what the "
        f"hands can go ({HAND_SPEED:g} m/s): are they in metres, and changes of the height?"
        for standing in comparison.overall.standings
        if standing.clipped is not None and standing.clipped > MOSTLY_CLIPPED
    ]


def provenance(comparison: Comparison, version: str) -> str:
    """Return what the comparison was made from."""
    suite, lifts = comparison.contest.suite, comparison.overall.episodes
    return f"colift {version}, suite {suite.name}, digest {suite.digest}, {lifts} lifts"


def digits(value: float) -> str:
    """Return the format of a positive number in which it has two digits or more."""
    if value < 1:
        return ".2f"
    return ".1f" if value < 100 else ".0f"


def between(interval: tuple[float, float], digits: str) -> str:
    """Return an interval in words, or nothing if it has no width."""
    low, high = interval
    return f"{low:{digits}} to {high:{digits}}" if high > low else ""


def p_value(p: float) -> str:
    """Return a p value; small ones as a bound."""
    return "< 0.001" if p < 0.001 else f"{p:.3f}"


def probability(value: float) -> str:
    """Return a probability; what is nearly certain as a bound."""
    if value < 0.005:
        return "< 0.01"
    return "> 0.99" if value >= 0.995 else f"{value:.2f}"


def parts_caption(kind: str, scopes: Sequence[Scope]) -> str:
    """Return how to read the table of one kind of scope, such as behaviours."""
    told = (
        f"RMSE in mm for each {kind}, and below it how far that is behind the best there, with the "
        "95 % interval."
    )
    return f"{told} {marks_caption('Bold', scopes)}"


def marks_caption(mark: str, scopes: Sequence[Scope]) -> str:
    """Return what a mark of the best says, or why there is none."""
    told = f"{mark}: the best, and those that cannot be told from it."
    few = [scope for scope in scopes if not scope.decisive]
    if not few:
        return told
    if len(few) == len(scopes):
        lifts = " or ".join(map(str, sorted({scope.episodes for scope in few})))
        return (
            f"None is marked as the best: {lifts} lifts in a column are too few to tell policies "
            "apart at 5 %."
        )
    return f"{told} No mark where lifts are too few for that: {_listed([s.name for s in few])}."


def undecided(overall: Scope) -> str:
    """Return that there are no ranks, if there are none."""
    if overall.decisive:
        return ""
    return f"No ranks: {overall.episodes} lifts are too few to tell policies apart at 5 %."


def _listed(names: list[str]) -> str:
    *first, last = names
    return f"{', '.join(first)} and {last}" if first else last
