"""The inspection of a run: its worst lifts, its phases, its parts, beside two people's."""

import html
from collections.abc import Callable, Container, Mapping
from concurrent.futures import Executor
from itertools import chain
from pathlib import Path

from colift.base.errors import InputError
from colift.benchmark.bundle import Results
from colift.benchmark.episode.loop import Episode
from colift.benchmark.execution.runner import Run, finished
from colift.benchmark.inspection import WORST
from colift.benchmark.inspection.findings import Findings, WorstLift
from colift.benchmark.inspection.moments import (
    Events,
    error_of,
    events_of,
    worst_moment,
)
from colift.benchmark.inspection.page import inspection_page, pictured_lifts
from colift.benchmark.inspection.phases import PhaseError, phase_errors, phase_scores
from colift.benchmark.inspection.text import inspection_text
from colift.benchmark.results.baselines import HUMAN_HUMAN, partner_spec
from colift.benchmark.results.lifts import (
    failures_by_reason,
    scored_lifts,
    worst_first,
)
from colift.benchmark.results.parts import part_scores
from colift.benchmark.results.scores import ScoreTable
from colift.benchmark.suites.suite import Suite
from colift.benchmark.tables.html import html_of
from colift.benchmark.tables.printing import text_of


class Inspection(Findings):
    """The reasons of a score, beside two people on the same lifts."""

    def __str__(self) -> str:
        """Return the tables and the lines between them."""
        return text_of(*inspection_text(self))

    def __repr__(self) -> str:
        """Return policy, suite and the worst lift in one line."""
        lift = self.worst[0].lift
        run = f"{self.run.policy} on {self.run.suite.name}"
        return f"<Inspection of {run}: worst {lift.name}, {lift.rmse_mm:.1f} mm>"

    def _repr_html_(self) -> str:
        """Return the view of a notebook: pictures of the worst lifts, and the text."""
        pictures = "".join(
            f'<figure style="margin: 0 0 1em"><img style="max-width: 100%" src="{each.source}" '
            f'alt="{html.escape(each.lift.name)}"><figcaption>{html.escape(each.moment)}'
            "</figcaption></figure>"
            for each in pictured_lifts(self)
            if each.source
        )
        return f"{pictures}{html_of(*inspection_text(self))}"

    def page(self) -> str:
        """Return the same as an HTML file that needs nothing else."""
        return inspection_page(self)


def inspect_run(
    run: Run,
    results: Results,
    *,
    worst: int = WORST,
    folder: Path | None = None,
    executor: Executor | None = None,
    progress: Callable[[int], None] = lambda episodes: None,
) -> Inspection:
    """Return the inspection of a run; two people play each of its lifts.

    Parameters
    ----------
    run, results
        The run, and its results with the human-human baseline.
    worst
        Number of lifts with the largest error, 1 or more.
    folder
        The bundle that the run was read from, if there is one.
    executor
        Plays the lifts of two people; None plays them in this process.
    progress
        Called with each number of lifts that they have played.

    Raises
    ------
    InputError
        If ``worst`` is below 1.
    EvaluatorFault, KeyboardInterrupt
        As :func:`.run_suite`.
    """
    if worst < 1:
        raise InputError(f"worst must be 1 or more, got {worst}")
    lifts = tuple(scored_lifts(run, results.baselines.get(HUMAN_HUMAN)))
    rows = worst_first(lift.rmse_mm for lift in lifts)[:worst]
    played = [run.suite.at(place) for place in run.places]
    events = {due.place: events_of(due.scenario, due.seed) for due in played}
    kept = {played[row].place for row in rows}
    people, theirs = _beside(run.suite, events, kept, executor, progress)
    mine = (
        phase_errors(events[due.place], error_of(due.scenario, episode.trace))
        for due, episode in zip(played, run.episodes, strict=True)
    )
    scores = ScoreTable.of(run)
    return Inspection(
        run=run,
        results=results,
        worst=tuple(
            WorstLift(
                lift=lifts[row],
                episode=run.episodes[row],
                scenario=due.scenario,
                human_human=people[due.place],
                moment=worst_moment(
                    run.episodes[row],
                    due.scenario,
                    events[due.place],
                    people[due.place].trace,
                ),
            )
            for row, due in ((row, played[row]) for row in rows)
        ),
        parts=part_scores(results.strata, lambda part: scores.part(part.behaviour).error),
        phases=phase_scores(chain.from_iterable(mine), theirs),
        failures=tuple(failures_by_reason(lifts)),
        folder=folder,
    )


def _beside(
    suite: Suite,
    events: Mapping[int, Events],
    kept: Container[int],
    executor: Executor | None,
    progress: Callable[[int], None],
) -> tuple[dict[int, Episode], list[PhaseError]]:
    """Let two people play the lifts at the places of ``events``.

    Return their lifts at the places in ``kept``, and their errors in all phases.
    """
    found: dict[int, Episode] = {}
    errors: list[PhaseError] = []
    lifts = finished(
        partner_spec(suite.scenarios[0]),
        suite.with_partner("human"),
        without={*range(suite.size)} - events.keys(),
        executor=executor,
        progress=progress,
    )
    for place, episode in lifts:
        scenario = suite.at(place).scenario
        errors += phase_errors(events[place], error_of(scenario, episode.trace))
        if place in kept:
            found[place] = episode
    return found, errors
