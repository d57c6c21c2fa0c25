"""The replay of a bundle's episodes, in this process or on any executor, and their checks."""

from collections.abc import Callable, Iterator, Mapping, Sequence
from concurrent.futures import Executor, as_completed
from dataclasses import dataclass

import numpy as np
from colift.base.errors import EvaluatorFault, InputError, error_text
from colift.benchmark.bundle import Bundle, one_line
from colift.benchmark.bundle.files import EPISODES, MANIFEST, TRACES
from colift.benchmark.channels import Channel
from colift.benchmark.episode.blame import blaming_plugins
from colift.benchmark.episode.kept_world import drop_kept_world
from colift.benchmark.episode.lift import Lift
from colift.benchmark.episode.loop import Episode
from colift.benchmark.episode.metric import Scores
from colift.benchmark.episode.replay import ReplayError, replay
from colift.benchmark.episode.scenario import Scenario
from colift.benchmark.episode.trace import Trace
from colift.benchmark.execution.batches import LIFTS_PER_BATCH
from colift.benchmark.execution.sessions import known_lifts
from colift.benchmark.suites.suite import Due, Suite, alike
from colift.benchmark.tasks.worlds import played_lift
from colift.benchmark.verification.channel_check import channel_fault
from colift.benchmark.verification.deviation import Place, beyond_tolerance, first_difference
from colift.benchmark.verification.far_hand import far_actions
from colift.benchmark.verification.verdict import Finding


@dataclass(frozen=True, kw_only=True, eq=False)
class Checked:
    """The result of an episode's replay."""

    index: int
    """The place of the episode in the suite."""
    scores: Scores | None = None
    """The scores that follow from the actions; None if the actions are not those of an episode."""
    failure: str | None = None
    """The failure that follows from the actions, or that is claimed and fits them."""
    bit_equal: bool = False
    """Whether every bit of the log equals the simulation's."""
    finding: Finding | None = None
    """The fault of the log; None if there is none."""


@dataclass(frozen=True, kw_only=True, eq=False)
class EpisodeCheck:
    """Some episodes of a suite, to be simulated again."""

    lifts: tuple[Due, ...]
    episodes: tuple[Episode, ...]
    """The claimed episodes of these lifts."""
    same_platform: bool
    """Whether equal bits are demanded."""
    channel: Channel | None = None
    """The claimed channel to the policy."""

    def __call__(self) -> list[Checked]:
        """Return the result of each replay; worker processes run this."""
        return list(self.results())

    def results(self) -> Iterator[Checked]:
        """Yield the result of each replay."""
        claims, demanded = iter(self.episodes), self.same_platform
        for scenario, some in alike(self.lifts):
            with played_lift(scenario) as lift:
                for due in some:
                    with blaming_plugins(scenario, due.seed):
                        checked = _check(
                            lift, due, next(claims), self.channel, same_platform=demanded
                        )
                    yield checked


def _check(
    lift: Lift,
    due: Due,
    claim: Episode,
    channel: Channel | None,
    *,
    same_platform: bool,
) -> Checked:
    index, scenario, seed = due
    name, logged = f"{scenario.name} seed {seed}", claim.trace

    def finding(message: str, file: str = TRACES, step: int | None = None) -> Finding:
        return Finding(file=file, episode=one_line(name), step=step, message=message)

    fault = _other_hand(scenario, logged) or channel_fault(channel, scenario, seed, logged)
    if fault is not None:
        step, message = fault
        return Checked(index=index, finding=finding(message, step=step))
    try:
        found = replay(lift, seed, logged.human_action, logged.action, claim.failure)
    except ReplayError as error:
        step, message = _first(logged, error, same_platform=same_platform)
        return Checked(index=index, finding=finding(message, step=step))
    except InputError as error:
        return Checked(index=index, finding=finding(str(error), file=MANIFEST))
    difference = first_difference(logged, found)
    bit_equal, scores = difference is None, found.scores
    if not (bit_equal or same_platform):
        difference = beyond_tolerance(logged, found)
        if difference is None:
            # If the log is within the tolerance, the scores must follow from it.
            scores = lift.task.score(lift, logged, failed=found.failure is not None)
    wrong = None
    if difference is not None:
        step, message = difference
        wrong = finding(message, step=step)
    elif found.failure != claim.failure:
        message = f"failure says {claim.failure!r}, the simulation gives {found.failure!r}"
        wrong = finding(message, file=EPISODES)
    return Checked(
        index=index, scores=scores, failure=found.failure, bit_equal=bit_equal, finding=wrong
    )


def _other_hand(scenario: Scenario, logged: Trace) -> Place | None:
    """Return the first step whose action does not follow from a second person's hand, or None."""
    steps = len(logged.action)
    expected = far_actions(scenario, steps)
    if expected is None:
        return None
    equal = (expected.view(np.uint64) == np.ascontiguousarray(logged.action).view(np.uint64)).all(
        axis=1
    )
    if equal.all():
        return None
    return int(equal.argmin()), "the action is not that of the hand at the far end"


def _first(logged: Trace, error: ReplayError, *, same_platform: bool) -> Place:
    """Return the first fault of actions that cannot be replayed to the end."""
    differs = first_difference if same_platform else beyond_tolerance
    return differs(logged.until(error.step), error.found) or (error.step, error.message)


def simulate(
    bundle: Bundle,
    suite: Suite,
    rows: Sequence[int] | None = None,
    *,
    same_platform: bool,
    executor: Executor | None,
    progress: Callable[[int], None],
) -> list[Checked]:
    """Return the result of each episode's replay, in the order of the bundle.

    ``rows`` are those of the episodes to replay; None is all of them.

    Raises
    ------
    EvaluatorFault
        If a worker died.
    InputError
        If the task or the behaviour of another package failed.
    """
    found: list[Checked] = []
    for part in _parts(episode_checks(bundle, suite, same_platform, rows), executor):
        found += part
        progress(len(part))
    return sorted(found, key=lambda checked: checked.index)


def episode_checks(
    bundle: Bundle, suite: Suite, same_platform: bool, rows: Sequence[int] | None = None
) -> list[EpisodeCheck]:
    """Return the checks, of some lifts each; ``rows`` as for :func:`simulate`.

    What the person of a session knows in a lift follows from the logs of the lifts before, each of
    which is checked itself.
    """
    every = range(len(bundle.indices)) if rows is None else rows
    logged = _Traces(dict(zip(bundle.indices, bundle.episodes, strict=True)))
    lifts = list(known_lifts(suite, [bundle.indices[row] for row in every], logged))
    return [
        EpisodeCheck(
            lifts=tuple(lifts[first : first + LIFTS_PER_BATCH]),
            episodes=tuple(bundle.episodes[row] for row in every[first : first + LIFTS_PER_BATCH]),
            same_platform=same_platform,
            channel=bundle.recipe.channel,
        )
        for first in range(0, len(every), LIFTS_PER_BATCH)
    ]


class _Traces(Mapping[int, Trace]):
    """The traces of episodes by place, read when they are asked for."""

    def __init__(self, episodes: Mapping[int, Episode]) -> None:
        self._episodes = episodes

    def __getitem__(self, place: int) -> Trace:
        return self._episodes[place].trace

    def __iter__(self) -> Iterator[int]:
        return iter(self._episodes)

    def __len__(self) -> int:
        return len(self._episodes)


def _parts(
    checks: Sequence[EpisodeCheck], executor: Executor | None
) -> Iterator[Sequence[Checked]]:
    if executor is None:
        try:
            for check in checks:
                for checked in check.results():
                    yield [checked]
        finally:
            drop_kept_world()
        return
    futures = [executor.submit(check) for check in checks]
    try:
        for future in as_completed(futures):
            yield future.result()
    except InputError:
        raise
    except Exception as error:
        raise EvaluatorFault(f"a worker of the verification failed: {error_text(error)}") from error
    finally:
        for future in futures:
            future.cancel()
