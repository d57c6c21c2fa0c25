"""Single lifts of a run, each beside two people on the same lift."""

import operator
import re
from collections.abc import Iterable, Iterator
from dataclasses import dataclass

from colift.benchmark.episode.turns import STEP
from colift.benchmark.execution.runner import Run
from colift.benchmark.results.scores import ScoreTable


def lift_name(behaviour: str, subject: str, trial: str, seed: int) -> str:
    """Return the name of a lift, such as ``pause/S3 seed 4``."""
    return f"{'/'.join(filter(None, (behaviour, subject, trial)))} seed {seed}"


@dataclass(frozen=True, kw_only=True)
class ScoredLift:
    """The outcome of one lift."""

    behaviour: str
    subject: str
    trial: str = ""
    """Name of the recording, empty for a drawn plan."""
    seed: int
    rmse_mm: float
    human_human_mm: float | None
    """RMSE of two people on this lift [mm]; None if it is not known."""
    failure: str | None
    """Reason of a failure, in the policy's own words if the policy failed."""

    @property
    def name(self) -> str:
        """Its name; see :func:`lift_name`."""
        return lift_name(self.behaviour, self.subject, self.trial, self.seed)

    @property
    def ratio(self) -> float | None:
        """The RMSE over that of two people; None without theirs, or if theirs is 0."""
        return self.rmse_mm / self.human_human_mm if self.human_human_mm else None


def scored_lifts(run: Run, human_human: ScoreTable | None) -> Iterator[ScoredLift]:
    """Yield the lifts of a run, in its order.

    ``human_human`` is the human-human baseline on the same lifts, if it is known.
    """
    people = None if human_human is None else human_human.lifts_at(run.places)
    for row, episode in enumerate(run.episodes):
        yield ScoredLift(
            behaviour=episode.behaviour,
            subject=episode.subject,
            trial=episode.trial,
            seed=episode.seed,
            rmse_mm=episode.scores["rmse_mm"],
            human_human_mm=None if people is None else people[row],
            failure=episode.failure,
        )


def worst_first(rmse_mm: Iterable[float]) -> list[int]:
    """Return the indices of lifts by their RMSE, the largest first; of equal ones the last."""
    return [i for i, _ in sorted(enumerate(rmse_mm), key=operator.itemgetter(1, 0), reverse=True)]


def worst_of_behaviours(lifts: Iterable[ScoredLift]) -> list[ScoredLift]:
    """Return the worst lift of each behaviour, in order of appearance."""
    known = list(lifts)
    ordered = worst_first(lift.rmse_mm for lift in known)
    worst = {known[i].behaviour: known[i] for i in reversed(ordered)}
    return [worst[each] for each in dict.fromkeys(lift.behaviour for lift in known)]


def failures_by_reason(lifts: Iterable[ScoredLift]) -> list[tuple[str, list[ScoredLift]]]:
    """Return the lifts that failed by the reason, the most frequent reason first.

    A reason is as in its first lift, with the step; the same in another step is the same reason.
    """
    found: dict[str, list[ScoredLift]] = {}
    for lift in lifts:
        if lift.failure is not None:
            found.setdefault(re.sub(rf"^{STEP}\d+: ", "", lift.failure), []).append(lift)
    by_first = [(str(some[0].failure), some) for some in found.values()]
    return sorted(by_first, key=lambda each: -len(each[1]))
