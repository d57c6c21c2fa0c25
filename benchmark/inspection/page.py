"""An inspection as one HTML file that needs nothing else."""

import io
from base64 import b64encode
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from typing import Final

from colift.benchmark.inspection import captions
from colift.benchmark.inspection.findings import Findings, WorstLift
from colift.benchmark.inspection.phases import PhaseScore
from colift.benchmark.rendering.axis import make_axis
from colift.benchmark.rendering.film import still_picture
from colift.benchmark.rendering.formats import number, words
from colift.benchmark.rendering.page import Cell, Row, render, style
from colift.benchmark.results.curve import session_axis
from colift.benchmark.results.headline import headline
from colift.benchmark.results.lifts import ScoredLift
from markupsafe import Markup
from PIL import Image

MOST_REASONS: Final = 20
"""Number of reasons of failures that are shown."""


@dataclass(frozen=True, kw_only=True)
class PicturedLift:
    """A lift with its picture."""

    lift: ScoredLift
    moment: str
    """Its worst moment, in sentences."""
    source: str
    """The picture as a data URL; empty if the lift ended before its first frame."""


def pictured_lifts(
    found: Findings, drawn: Callable[[int], None] = lambda pictures: None
) -> Iterator[PicturedLift]:
    """Yield the worst lifts with their pictures; ``drawn`` is called with 1 after each."""
    for each in found.worst:
        source = _still(each, found.run.policy)
        yield PicturedLift(lift=each.lift, moment=captions.moment_words(found, each), source=source)
        drawn(1)


def inspection_page(found: Findings, drawn: Callable[[int], None] = lambda pictures: None) -> str:
    """Return the page: the worst lifts with pictures, strengths and weaknesses, phases, failures.

    Parameters
    ----------
    found
        The inspection.
    drawn
        Called with 1 after each picture of a lift.
    """
    return render(
        __package__,
        "inspect.html",
        style=Markup(style("strata.css")),
        title=captions.title(found),
        headline=headline(found.results.summary),
        verdict=captions.verdict(found),
        provenance=captions.provenance(found),
        worst_caption=captions.worst_caption(found),
        worst=[*pictured_lifts(found, drawn)],
        parts=found.parts,
        axis=make_axis(
            [each.rmse_mm for each in found.parts],
            [mark for each in found.parts for mark in each.marks],
        ),
        session=found.results.session,
        session_axis=session_axis(found.results.session),
        phases_caption=captions.phases_caption(found),
        phases_header=captions.phases_head(found),
        phases=_rows(found.phases),
        failures=found.failures,
        most_reasons=MOST_REASONS,
    )


def _still(worst: WorstLift, policy: str) -> str:
    """Return the still of a lift as a data URL; empty if there is none."""
    if worst.moment is None:
        return ""
    data = io.BytesIO()
    picture = still_picture(worst.episode, worst.scenario, policy)
    Image.fromarray(picture).save(data, "PNG", optimize=True)
    return f"data:image/png;base64,{b64encode(data.getvalue()).decode('ascii')}"


def _rows(phases: Sequence[PhaseScore]) -> list[Row]:
    return [
        Row(
            words(each.name),
            [
                Cell(f"{each.time_share:.0%}"),
                Cell(f"{each.error_share:.0%}"),
                Cell(number(each.rmse_mm)),
                Cell(number(each.human_human_mm)),
            ],
        )
        for each in phases
    ]
