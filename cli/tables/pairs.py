"""The measures of recorded pairs as a table for a terminal."""

from collections.abc import Iterator
from typing import Final

from colift.benchmark.comparison.formatting import between
from colift.benchmark.pairs.coordination import measure_of
from colift.benchmark.pairs.summary import Averaged, PairsSummary
from colift.benchmark.statistics import Estimate
from colift.benchmark.tables.printing import counted, table
from rich.table import Table

FEW: Final = 10
"""Number of lifts below which an interval says little."""


def pairs_table(summary: PairsSummary) -> Table:
    """Return the measures of recorded pairs beside those of the simulated two people."""
    named = summary.people > 1
    people = ("95 %, pairs",) if named else ()
    return table(
        f"Pairs of {summary.source}, beside the simulated two people",
        ("", "recorded", "95 %, lifts", *people, "simulated", "difference, 95 %"),
        (_row(name, each, named) for name, each in summary.averages.items()),
        caption=" ".join((*_sample(summary), *_meanings(summary))),
    )


def _row(name: str, each: Averaged, named: bool) -> list[str]:
    measure = measure_of(name)
    digits = f".{measure.digits}f"
    others = ((between(each.over_pairs.ci95, digits) if each.over_pairs else ""),) if named else ()
    return [
        f"{measure.label}, {measure.unit}" if measure.unit else measure.label,
        f"{each.recorded.mean:{digits}}",
        between(each.recorded.ci95, digits),
        *others,
        "" if each.simulated is None else f"{each.simulated.mean:{digits}}",
        _difference(each.difference, measure.digits),
    ]


def _difference(found: Estimate | None, digits: int) -> str:
    if found is None:
        return ""
    interval = between(found.ci95, f"+.{digits}f")
    return f"{found.mean:+.{digits}f}" + (f" ({interval})" if interval else "")


def _sample(summary: PairsSummary) -> Iterator[str]:
    """Yield sentences on what the intervals hold for."""
    lifts = len(summary.lifts)
    if summary.people > 1:
        yield (
            f"{counted(lifts, 'lift')} of {counted(summary.people, 'pair')}. Intervals over lifts "
            "hold for further lifts of these pairs, those over pairs, and of the difference, for "
            "other pairs."
        )
    else:
        why = "all of one pair" if summary.people else "the file names no pairs"
        yield (
            f"{counted(lifts, 'lift')}, {why}: intervals hold for further lifts of the same "
            "people, and say nothing about other pairs."
        )
    if lifts < FEW:
        yield f"Fewer than {FEW} lifts say little."
    without: dict[int, list[str]] = {}
    for name, each in summary.averages.items():
        without.setdefault(each.missing, []).append(measure_of(name).label)
    for count, labels in without.items():
        if count:
            yield f"{counted(count, 'lift')} without {'; '.join(labels)}."


def _meanings(summary: PairsSummary) -> Iterator[str]:
    for name in summary.averages:
        measure = measure_of(name)
        if measure.meaning:
            yield f"{measure.label[0].upper()}{measure.label[1:]}: {measure.meaning}."
    yield (
        "Simulated: the near hand moves as recorded, at its own height and pace, and a simulated "
        "person holds the other end of a table of 0.8 m."
    )
