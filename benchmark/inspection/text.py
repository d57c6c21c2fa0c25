"""An inspection as tables and text for a terminal."""

from collections.abc import Iterator
from typing import Final

from colift.benchmark.bundle import one_line
from colift.benchmark.inspection.captions import (
    PARTS,
    distances,
    phases_caption,
    phases_head,
    provenance,
    shown,
    title,
    verdict,
    worst_caption,
)
from colift.benchmark.inspection.findings import Findings, WorstLift
from colift.benchmark.rendering.formats import words
from colift.benchmark.results.headline import headline
from colift.benchmark.results.parts import PartScore
from colift.benchmark.tables.printing import Cell, counted, left, optional_number, styled, table
from colift.benchmark.tables.results_table import curve_lines
from rich.console import RenderableType
from rich.table import Table

MOST_REASONS: Final = 5
"""Number of reasons of failures that are shown."""


def inspection_text(found: Findings) -> Iterator[RenderableType]:
    """Yield the tables and texts of an inspection, to be printed by :func:`.show`."""
    yield f"{title(found)}: {headline(found.results.summary)}"
    if said := verdict(found):
        yield said
    yield _worst_table(found)
    scored = [f"{each.lift.name}: {distances(found, each)}" for each in found.worst]
    if shown(found) != "error":
        yield "\n".join([*scored, ""])
    yield _parts_table(found.parts)
    if found.results.session is not None:
        yield "\n".join(curve_lines(found.results.session))
    if found.phases:
        yield _phases_table(found)
    yield provenance(found)
    for reason, lifts in found.failures[:MOST_REASONS]:
        yield f"{counted(len(lifts), 'lift')} failed, first {lifts[0].name}: {one_line(reason)}"


def _worst_table(found: Findings) -> Table:
    return table(
        "Worst lifts",
        (
            *("lift", "RMSE mm", "two\npeople"),
            *("at s", f"{shown(found)} mm", "two\npeople"),
            left("the person"),
        ),
        map(_worst_row, found.worst),
        caption=worst_caption(found),
    )


def _worst_row(worst: WorstLift) -> list[str]:
    lift, moment = worst.lift, worst.moment
    scores = (f"{lift.rmse_mm:.1f}", optional_number(lift.human_human_mm, ".1f"))
    if moment is None:
        return [lift.name, *scores, "", "", "", "failed before the first frame"]
    return [
        lift.name,
        *scores,
        f"{moment.time_s:.2f}",
        f"{moment.error_mm:+.0f}",
        optional_number(moment.human_human_mm, "+.0f"),
        moment.doing if lift.failure is None else f"failed: {moment.doing}",
    ]


def _parts_table(parts: tuple[PartScore, ...]) -> Table:
    whole, *behaviours = map(_part_row, parts)
    return table(
        "Strengths and weaknesses",
        ("human", "RMSE mm", "two people", "ratio", "best person", "worst person", "failed"),
        [*behaviours, None, styled(whole, "bold")],
        caption=PARTS,
    )


def _part_row(each: PartScore) -> list[Cell]:
    spread = each.spread
    return [
        "all" if each.part.behaviour is None else words(each.part.behaviour),
        f"{each.rmse_mm.mean:.1f}",
        optional_number(each.human_human_mm, ".1f"),
        optional_number(each.ratio, ".2f"),
        "" if spread is None else f"{spread.best:.1f}",
        "" if spread is None else f"{spread.worst:.1f} {spread.worst_person}",
        f"{each.failed} of {each.episodes}",
    ]


def _phases_table(found: Findings) -> Table:
    return table(
        "Phases of a lift",
        phases_head(found),
        [
            (
                words(each.name),
                f"{each.time_share:.0%}",
                f"{each.error_share:.0%}",
                f"{each.rmse_mm:.1f}",
                optional_number(each.human_human_mm, ".1f"),
            )
            for each in found.phases
        ],
        caption=phases_caption(found),
    )
