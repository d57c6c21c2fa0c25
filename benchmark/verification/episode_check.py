"""The check of some episodes of one scenario: what a worker does at a time."""

import contextlib
from collections.abc import Iterator
from dataclasses import dataclass

from ...agents.errors import InputError
from ..bundle import one_line
from ..bundle.files import EPISODES, MANIFEST, TRACES
from ..episode import Episode
from ..lift import Lift
from ..replay import ReplayError, replay
from ..scenario import Scenario
from ..scores import Scores, score
from ..trace import Trace
from .bits import Place, first_difference
from .tolerance import beyond_tolerance
from .verdict import Finding


@dataclass(frozen=True, kw_only=True, eq=False)
class Checked:
    """What the replay of an episode has shown."""

    place: int
    """Where in the suite the episode is."""
    scores: Scores | None = None
    """The scores that follow from the actions; None if they are not those of an episode."""
    failure: str | None = None
    """The failure that follows from the actions, or that is claimed and fits them."""
    bit_equal: bool = False
    """Whether every bit of the log is the simulation's."""
    finding: Finding | None = None
    """What is wrong with the log."""


@dataclass(frozen=True, kw_only=True, eq=False)
class EpisodeCheck:
    """Some episodes of one scenario, to be simulated again."""

    scenario: Scenario
    seeds: tuple[int, ...]
    places: tuple[int, ...]
    """Where in the suite each episode is."""
    episodes: tuple[Episode, ...]
    """What is claimed of each."""
    same_platform: bool
    """Whether equal bits are demanded."""

    def __call__(self) -> list[Checked]:
        """Return what each replay shows: what a worker process runs."""
        return list(self.results())

    def results(self) -> Iterator[Checked]:
        """Yield what each replay shows."""
        with contextlib.closing(Lift(self.scenario)) as lift:
            for claim in zip(self.places, self.seeds, self.episodes, strict=True):
                yield _check(lift, *claim, same_platform=self.same_platform)


def _check(lift: Lift, place: int, seed: int, claim: Episode, *, same_platform: bool) -> Checked:
    name, logged = f"{lift.scenario.name} seed {seed}", claim.trace

    def finding(message: str, file: str = TRACES, step: int | None = None) -> Finding:
        return Finding(file=file, episode=one_line(name), step=step, message=message)

    try:
        found = replay(lift, seed, logged.human_action, logged.action, claim.failure)
    except ReplayError as error:
        step, message = _first(logged, error, same_platform=same_platform)
        return Checked(place=place, finding=finding(message, step=step))
    except InputError as error:
        return Checked(place=place, finding=finding(str(error), file=MANIFEST))
    difference = first_difference(logged, found)
    bit_equal, scores = difference is None, found.scores
    if not (bit_equal or same_platform):
        difference = beyond_tolerance(logged, found)
        if difference is None:
            # The log is near enough; then it is what the scores must follow from.
            scores = score(lift, logged, failed=found.failure is not None)
    wrong = None
    if difference is not None:
        step, message = difference
        wrong = finding(message, step=step)
    elif found.failure != claim.failure:
        message = f"failure says {claim.failure!r}, the simulation gives {found.failure!r}"
        wrong = finding(message, file=EPISODES)
    return Checked(
        place=place, scores=scores, failure=found.failure, bit_equal=bit_equal, finding=wrong
    )


def _first(logged: Trace, error: ReplayError, *, same_platform: bool) -> Place:
    """Return where actions that cannot be replayed to the end are wrong first, and how."""
    differs = first_difference if same_platform else beyond_tolerance
    return differs(logged.until(error.step), error.found) or (error.step, error.message)
