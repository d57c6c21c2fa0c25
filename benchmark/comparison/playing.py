"""Playing a suite with policies, and with baseline and references where none are shipped."""

from collections.abc import Callable, Mapping, Sequence
from concurrent.futures import Executor
from dataclasses import dataclass
from functools import partial
from typing import Protocol

from colift.agents.spec import AgentSpec
from colift.benchmark.channels import Channel
from colift.benchmark.comparison.paired_results import PairedResults, PolicyResults
from colift.benchmark.episode.loop import Episode
from colift.benchmark.execution.journal import Journal
from colift.benchmark.execution.runner import Run, run_suite
from colift.benchmark.results.baselines import (
    HUMAN_HUMAN,
    human_human_run,
    shipped_baselines,
    shipped_references,
)
from colift.benchmark.results.scores import ScoreTable
from colift.benchmark.suites.suite import Suite


class Reference(Protocol):
    """Plays a suite with a robot that knows more than any policy may."""

    def __call__(
        self, suite: Suite, *, executor: Executor | None, progress: Callable[[int], None]
    ) -> Run:
        """Return the run; arguments as for :func:`.run_suite`."""


def episodes_to_play(policies: int, suite: Suite, *, references: int = 0) -> int:
    """Return the number of episodes that :func:`play_policies` will play."""
    human_human = shipped_baselines(suite) is None
    return suite.size * (policies + human_human + references * (shipped_references(suite) is None))


def play_policies(
    policies: Mapping[str, AgentSpec],
    suite: Suite,
    *,
    stored: Sequence[PolicyResults] = (),
    references: Mapping[str, Reference] | None = None,
    executor: Executor | None = None,
    progress: Callable[[int], None] = lambda episodes: None,
    channel: Channel | None = None,
    journal: Journal | None = None,
) -> PairedResults:
    """Play the suite with each policy, and with baseline and references where none are shipped.

    Parameters
    ----------
    policies
        Policies, by the name that tables use.
    suite, executor, progress
        As for :func:`.run_suite`.
    stored
        Results of policies that have played the suite before.
    references
        Bounds to play, by name, if none are shipped for the suite; shipped ones are always
        included.
    channel
        The channel of every policy, also of the stored ones; None is no channel.
    journal
        Where the episodes of the policies go when they are finished, one policy after the other;
        those in it are not played again.

    Raises
    ------
    InputError
        If a policy cannot be loaded.
    KeyboardInterrupt
        After Ctrl-C: without all episodes there are no pairs.
    """
    play = partial(run_suite, suite=suite, executor=executor, progress=progress, channel=channel)
    played = []
    for number, (name, spec) in enumerate(policies.items()):
        shelf = None if journal is None else _Part(journal, suite.size, number)
        run = play(spec, done={} if shelf is None else shelf.done(), shelf=shelf)
        played.append(PolicyResults.of(name, run))
    beside = known_references(references or {}, suite, executor=executor, progress=progress)
    shipped = shipped_baselines(suite)
    if shipped is None:
        human_human = ScoreTable.of(human_human_run(suite, executor=executor, progress=progress))
    else:
        human_human = shipped[HUMAN_HUMAN]
    return PairedResults(
        suite=suite,
        policies=(*played, *stored),
        human_human=human_human,
        references=beside,
        channel=channel,
    )


@dataclass(frozen=True, eq=False)
class _Part:
    """The episodes of one policy in the journal of several."""

    journal: Journal
    size: int
    """Number of episodes of a policy."""
    number: int
    """Place of the policy among the others, from 0."""

    def done(self) -> dict[int, Episode]:
        """Return the episodes that were finished earlier, by their place in the suite."""
        places = ((index - self.number * self.size, index) for index in self.journal.done)
        return {
            place: self.journal.done[index] for place, index in places if 0 <= place < self.size
        }

    def keep(self, index: int, episode: Episode) -> Episode:
        return self.journal.keep(self.number * self.size + index, episode)


def known_references(
    references: Mapping[str, Reference],
    suite: Suite,
    *,
    executor: Executor | None = None,
    progress: Callable[[int], None] = lambda episodes: None,
) -> dict[str, ScoreTable]:
    """Return the shipped references of a suite or, if there are none, those that were played."""
    shipped = shipped_references(suite)
    if shipped is not None:
        return shipped
    return play_references(references, suite, executor=executor, progress=progress)


def play_references(
    references: Mapping[str, Reference],
    suite: Suite,
    *,
    executor: Executor | None = None,
    progress: Callable[[int], None] = lambda episodes: None,
) -> dict[str, ScoreTable]:
    """Return the results of each reference on a suite; arguments as for :func:`play_policies`."""
    return {
        name: ScoreTable.of(play(suite, executor=executor, progress=progress))
        for name, play in references.items()
    }
