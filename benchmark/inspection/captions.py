"""Titles, captions and sentences of an inspection, for its tables and its page."""

import math
from collections.abc import Sequence
from typing import Final

from colift.benchmark.channels import channel_name
from colift.benchmark.episode.drawn import error_words, is_scored
from colift.benchmark.episode.metric import LEADING, drawn_series, on_boards
from colift.benchmark.inspection.findings import Findings, WorstLift
from colift.benchmark.rendering.formats import number, signed, words
from colift.benchmark.results.baselines import HUMAN_HUMAN_LABEL
from colift.benchmark.results.strata import StratumScore, vs_human_mean

PARTS: Final = (
    "two people: RMSE in mm of the human-human baseline on the same lifts. ratio: the RMSE divided "
    "by it, geometric mean over the lifts; below 1 is better than two people."
)
"""Meaning of the columns of strengths and weaknesses."""


def shown(found: Findings) -> str:
    """Return what pictures show: the error that is scored, or else the tilt of the table."""
    return "error" if is_scored(drawn_series(found.run.suite.metrics)) else "tilt"


def title(found: Findings) -> str:
    """Return policy and suite, with the channel if there was one."""
    run = found.run
    over = "" if run.channel is None else f", over the channel {channel_name(run.channel)}"
    part = "" if run.complete else f", {len(run.episodes)} of {run.suite.size} lifts"
    return f"{run.policy} on {run.suite.name}{over}{part}"


def provenance(found: Findings) -> str:
    """Return the origin of the numbers, in sentences."""
    digest = f"Suite digest {found.run.suite.digest}."
    if found.folder is None:
        return digest
    return (
        f"The policy's numbers are claims of the bundle {found.folder}, which 'colift verify' "
        f"checks; two people were simulated now. {digest}"
    )


def worst_caption(found: Findings) -> str:
    """Return the meaning of the table of worst lifts."""
    metrics, noun = found.run.suite.metrics, shown(found)
    scored = "" if noun == "error" else f" RMSE: {metrics[LEADING].meaning}."
    return (
        "The lifts with the largest RMSE, each beside two people on the same lift, with the moment "
        f"of its largest {noun} or of its failure. {noun.capitalize()}: "
        f"{error_words(drawn_series(metrics))}, in mm, beside that of two people at the same time."
        f"{scored}"
    )


def phases_caption(found: Findings) -> str:
    """Return the meaning of the table of phases."""
    noun = shown(found)
    return (
        f"A phase begins with an event of the person's plan. Time, {noun}: its share of the frames "
        f"and of the squared {noun}, over all lifts; frames after a failure are in no phase. "
        f"RMS: of the {noun} in the phase, in mm."
    )


def phases_head(found: Findings) -> tuple[str, ...]:
    """Return the column names of the table of phases."""
    return "phase", "time", shown(found), "RMS mm", HUMAN_HUMAN_LABEL


def verdict(found: Findings) -> str:
    """Return the best and the worst behaviour and person, as far as there are several."""
    strata = found.results.strata
    sentences = (
        _extremes("behaviour", [(words(each.behaviour), each) for each in strata]),
        _extremes("person", [(each.subject, each) for each in strata]),
    )
    return " ".join(filter(None, sentences))


def _extremes(kind: str, named: Sequence[tuple[str, StratumScore]]) -> str:
    """Return the names of strata with the smallest and the largest ratio to two people."""
    parts: dict[str, list[StratumScore]] = {}
    for name, stratum in named:
        parts.setdefault(name, []).append(stratum)
    ratios = {
        name: ratio for name, some in parts.items() if (ratio := vs_human_mean(some)) is not None
    }
    if len(ratios) < 2:
        return ""
    best, worst = (choose(ratios, key=ratios.__getitem__) for choose in (min, max))
    return (
        f"Best {kind}: {best}, {ratios[best]:.2f} times the error of two people; "
        f"worst: {worst}, {ratios[worst]:.2f} times."
    )


def moment_words(found: Findings, worst: WorstLift) -> str:
    """Return the worst moment of a lift as sentences, with the distances that are scored."""
    moment, failure = worst.moment, worst.episode.failure
    if moment is None:
        return f"It ended before its first frame: {failure}"
    said = f"Largest {shown(found)}" if failure is None else "Failed"
    return (
        f"{said} at {moment.time_s:.2f} s: {signed(moment.error_mm, 0)} mm, two people "
        f"{signed(moment.human_human_mm, 0)} mm. The person: {moment.doing}. "
        f"{distances(found, worst)}"
    ).rstrip()


def distances(found: Findings, worst: WorstLift) -> str:
    """Return the distances that a task scores instead of the shown error; empty if it has none."""
    if shown(found) == "error":
        return ""
    mine, theirs = worst.episode.scores, worst.human_human.scores
    said = (
        (metric.label, number(mine[metric.name]), number(theirs[metric.name]))
        for metric in on_boards(found.run.suite.metrics)
        if metric.unit == "mm" and not math.isnan(mine[metric.name])
    )
    return " ".join(f"{label} {mm} mm, two people {people} mm." for label, mm, people in said)
