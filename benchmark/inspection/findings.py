"""What an inspection finds, for text, captions and page."""

from dataclasses import dataclass
from pathlib import Path

from colift.benchmark.bundle import Results
from colift.benchmark.episode.loop import Episode
from colift.benchmark.episode.scenario import Scenario
from colift.benchmark.execution.runner import Run
from colift.benchmark.inspection.moments import Moment
from colift.benchmark.inspection.phases import PhaseScore
from colift.benchmark.results.lifts import ScoredLift
from colift.benchmark.results.parts import PartScore


@dataclass(frozen=True, kw_only=True, eq=False)
class WorstLift:
    """A lift with a large error."""

    lift: ScoredLift
    episode: Episode
    scenario: Scenario
    human_human: Episode
    """The same lift with two people."""
    moment: Moment | None
    """Its worst moment; None if it ended before its first frame."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Findings:
    """What an inspection found."""

    run: Run
    results: Results
    worst: tuple[WorstLift, ...]
    """The lifts with the largest RMSE, the largest first."""
    parts: tuple[PartScore, ...]
    """All lifts, then each behaviour."""
    phases: tuple[PhaseScore, ...]
    """The phases of the person's plans, the largest share of the error first; none of live lifts,
    whose plans nobody knows."""
    failures: tuple[tuple[str, list[ScoredLift]], ...]
    """The failed lifts by the reason, the most frequent reason first."""
    folder: Path | None
    """The bundle that claims the scores; None of a run of this process."""
