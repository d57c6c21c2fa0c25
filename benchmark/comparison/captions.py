"""Captions and sentences of a comparison's tables, picture and page."""

from collections.abc import Sequence
from typing import Final

from colift.benchmark.channels import channel_name
from colift.benchmark.comparison.compare import Comparison
from colift.benchmark.comparison.ranking import Ranking
from colift.benchmark.episode.metric import Metric
from colift.benchmark.results.baselines import HUMAN_HUMAN_LABEL
from colift.benchmark.results.goals import goal_scores
from colift.benchmark.results.roughness import MEANING, by_which
from colift.benchmark.tasks.level.table import MOSTLY_CLIPPED

SURE: Final = 0.975
"""Probability above which the 95 % interval of a difference excludes zero."""

RANK: Final = (
    "Rank: 1 + the number of policies that are better beyond chance; a larger error never has a "
    "smaller rank."
)
"""What a rank means, in one sentence."""

_RANK, _BASELINE, _INTERVALS = (
    RANK + " All pairs are tested together, by sign flips of people: the probability that any "
    "equal policies are told apart is at most 6 %.",
    "Two people: two simulated people on the same lifts. vs_human is the RMSE divided by theirs on "
    "the same lift, geometric mean: 1 is as {} as with a human partner, less is better.",
    "Intervals: 95 %, between people, each with all of their lifts. They show how much the value "
    "would vary with other people from the same population.",
)
"""Sentences on how to read a comparison of any task."""

Axes = tuple[Metric, Metric]
"""The leading metric and the one beside it in pictures."""

RANKS_CAPTION: Final = (
    "Small print: 95 % intervals; for the time per step, the median above its 99th percentile. "
    f"{RANK}"
)

AGAINST_CAPTION: Final = (
    "Paired difference of each policy's RMSE to the best policy's, with its 95 % interval; p value "
    "of this difference, corrected for all pairs; share of the lifts in which its RMSE is the "
    f"lower one; probability that vs_human is below 1, that of {HUMAN_HUMAN_LABEL}, with other "
    "people."
)


def how_to_read(axes: Axes) -> tuple[str, ...]:
    """Return the sentences on how to read a comparison."""
    leading, second = axes
    baseline = _BASELINE.format(leading.words.praise[0])
    return (leading.reading, _RANK, baseline, second.reading, _INTERVALS)


def picture_axis(axes: Axes) -> str:
    """Return the name of the picture's axis across."""
    leading, _ = axes
    return f"← {leading.words.praise[1]} · {leading.axis}"


def picture_caption(axes: Axes, front: Sequence[str]) -> str:
    """Return the sentences on how to read the picture, in which a line joins a front of several."""
    leading, second = axes
    both = f"both mean {leading.symbol} and mean {second.symbol}"
    joined = f"The line joins the Pareto front: the policies that no other policy beats in {both}. "
    if len(front) == 1:
        joined = f"{front[0]} alone is the Pareto front: it is the best in {both}. "
    return (
        "Higher and further left is better. Bars are 95 % intervals. "
        f"{joined if front else ''}The diamond is {HUMAN_HUMAN_LABEL}; squares "
        "are references, which have no rank."
    )


def title(comparison: Comparison) -> str:
    """Return the number of policies, the suite and the channel, in one line."""
    results = comparison.results
    over = "" if results.channel is None else f", over the channel {channel_name(results.channel)}"
    return f"{len(results.policies)} policies on {results.suite.name}{over}"


def picture_title(comparison: Comparison) -> str:
    """Return the title of the picture."""
    (level, _, _), (smooth, _, _) = _praise(comparison)
    return f"How {level} and how {smooth}: {title(comparison)}"


def verdict(comparison: Comparison) -> str:
    """Return the best policy, those of its rank, and its results against two people."""
    overall = comparison.overall
    (_, more_level, most_level), _ = _praise(comparison)
    best, *others = overall.policies
    text = (
        f"{best.name} is the {most_level}: {best.rmse_mm.mean:.1f} mm, "
        f"{best.vs_human.mean:.2f} times the error of {HUMAN_HUMAN_LABEL} on the same lift "
        f"(mean {overall.human_human_rmse_mm.mean:.1f} mm)."
    )
    equals = [ranked.name for ranked in others if ranked.same_as_best]
    if not overall.decisive:
        text += f" But {people_text(overall.people)} too few to rank the policies."
    elif equals:
        text += f" {_listed(equals)} cannot be distinguished from it."
    if (best.better_than_human or 0.0) > SURE:
        return f"{text} It is {more_level} than two people."
    won = [
        ranking.name
        for ranking in comparison.behaviours
        for ranked in ranking.policies
        if ranked.name == best.name and (ranked.better_than_human or 0.0) > SURE
    ]
    return f"{text} On {_listed(won)} it is {more_level} than two people." if won else text


def remarks(comparison: Comparison) -> list[str]:
    """Return the verdict, and what else is to be known about the policies."""
    return [
        verdict(comparison),
        *roughness(comparison),
        *goals(comparison),
        *unit_warnings(comparison),
    ]


def failures(comparison: Comparison) -> list[str]:
    """Return a sentence per policy that failed in a lift."""
    sentences = []
    for policy in comparison.results.policies:
        failures = policy.scores.failures
        reasons = [failure for failure in failures if failure is not None]
        if reasons:
            sentences.append(
                f"{policy.name}: {len(reasons)} of {len(failures)} lifts failed and count "
                f"as worst; first reason: {reasons[0]}"
            )
    return sentences


def roughness(comparison: Comparison) -> list[str]:
    """Return the meaning of the mark, and by which metrics each marked policy is rougher."""
    marked = [ranked for ranked in comparison.overall.policies if ranked.rougher]
    metrics = comparison.results.suite.metrics
    by = (f"{ranked.name} by {by_which(ranked.rougher or (), metrics)}" for ranked in marked)
    return [f"{MEANING} {'; '.join(by)}."] if marked else []


def goals(comparison: Comparison) -> list[str]:
    """Return the sentence on how well people reached the goals, if the lifts are live ones."""
    scores = goal_scores(comparison.results.suite)
    return [] if scores is None else [str(scores)]


def unit_warnings(comparison: Comparison) -> list[str]:
    """Return a sentence per policy whose actions are probably not in metres."""
    speed = comparison.results.suite.hand_speed
    return [
        f"{ranked.name}: {100 * ranked.clipped:.0f} % of its actions were clipped to the "
        f"speed of the hands ({speed:g} m/s): are they changes of the height, in metres?"
        for ranked in comparison.overall.policies
        if ranked.clipped is not None and ranked.clipped > MOSTLY_CLIPPED
    ]


def provenance(comparison: Comparison, version: str) -> str:
    """Return version, suite, digest, number of lifts and channel."""
    suite, lifts = comparison.results.suite, comparison.overall.episodes
    channel = comparison.results.channel
    over = "" if channel is None else f", channel {channel_name(channel)}"
    return f"colift {version}, suite {suite.name}, digest {suite.digest}, {lifts} lifts{over}"


def parts_caption(kind: str, rankings: Sequence[Ranking]) -> str:
    """Return the caption of the table by one kind of subset, such as behaviours."""
    return (
        f"RMSE in mm for each {kind}; below it, the difference to the best policy of the column, "
        f"with its 95 % interval. {marks_caption('Bold', rankings)}"
    )


def marks_caption(mark: str, rankings: Sequence[Ranking]) -> str:
    """Return the meaning of the mark of the best, or the reason why there is none."""
    meaning = f"{mark}: no policy is better beyond chance."
    few = [ranking for ranking in rankings if not ranking.decisive]
    if not few:
        return meaning
    if len(few) == len(rankings):
        most = max(ranking.people for ranking in few)
        return f"No policy is marked as the best: {people_text(most)} too few for any difference."
    return f"{meaning} No mark where the people are too few: {_listed([s.name for s in few])}."


def undecided(overall: Ranking) -> str:
    """Return the reason why there are no ranks; empty if there are ranks."""
    if overall.decisive:
        return ""
    return f"No ranks: {people_text(overall.people)} too few for any difference beyond chance."


def people_text(count: int) -> str:
    """Return a number of people, as the beginning of a sentence about them."""
    return "a single person is" if count == 1 else f"{count} people are"


def _praise(comparison: Comparison) -> tuple[tuple[str, str, str], tuple[str, str, str]]:
    """Return the words for good values of the leading metric and of the one beside it."""
    leading, second = comparison.results.axes
    return leading.words.praise, second.words.praise


def _listed(names: list[str]) -> str:
    *first, last = names
    return f"{', '.join(first)} and {last}" if first else last
