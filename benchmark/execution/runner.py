"""The run of a policy on a suite, in this process or on any executor."""

from collections.abc import Callable, Container, Iterator, Mapping
from concurrent.futures import Executor
from dataclasses import dataclass

from colift.agents.spec import AgentSpec
from colift.base.engine import require_engine
from colift.benchmark.channels import Channel
from colift.benchmark.episode.loop import Episode
from colift.benchmark.execution.batches import Faults, batches, run_batches, shuffled_batches
from colift.benchmark.execution.packaging import packaged
from colift.benchmark.execution.shelf import Shelf, Spool
from colift.benchmark.suites.suite import Suite


@dataclass(frozen=True, kw_only=True, eq=False)
class Run:
    """A policy's episodes on a suite, in the suite's order: scenarios, then seeds."""

    policy: str
    """The policy's name."""
    policy_digest: str
    """Hash of the policy's source."""
    suite: Suite
    episodes: tuple[Episode, ...]
    isolation: str = "none"
    """The policy's isolation level."""
    faults: int = 0
    """Number of episodes that were played again because the machine had failed."""
    channel: Channel | None = None
    """The channel between the robot and the policy; None if there is none."""

    @property
    def places(self) -> list[int]:
        """The place in the suite of each episode, counted from 0."""
        if self.complete:
            return list(range(self.suite.size))
        names = [
            (scenario.behaviour, scenario.subject.name, scenario.trial, seed)
            for scenario in self.suite.scenarios
            for seed in self.suite.seeds
        ]
        found: list[int] = []
        for episode in self.episodes:
            name = (episode.behaviour, episode.subject, episode.trial, episode.seed)
            found.append(names.index(name, found[-1] + 1 if found else 0))
        return found

    @property
    def complete(self) -> bool:
        """Whether every episode of the suite is there."""
        return len(self.episodes) == self.suite.size


class InterruptedRunError(KeyboardInterrupt):
    """Ctrl-C during a run; the finished episodes are in :attr:`run`."""

    def __init__(self, run: Run) -> None:
        super().__init__(f"interrupted after {len(run.episodes)} of {run.suite.size} lifts")
        self.run = run


def placed(policy: AgentSpec, executor: Executor | None) -> AgentSpec:
    """Return the policy as an executor needs it: packaged if machines do not share files.

    Raises
    ------
    InputError
        If there is no such policy, or its files are larger than a submission may be.
    """
    return policy if getattr(executor, "shares_files", True) else packaged(policy)


def finished(
    policy: AgentSpec,
    suite: Suite,
    *,
    without: Container[int] = (),
    executor: Executor | None = None,
    progress: Callable[[int], None] = lambda episodes: None,
) -> Iterator[tuple[int, Episode]]:
    """Yield the place of each episode, and the episode, as it is finished; none is kept.

    Places in ``without`` are left out. Other arguments and errors are those of :func:`run_suite`.
    """
    policy = placed(policy, executor)
    policy.check()
    wanted = batches(policy, suite, without)
    for index, episode in run_batches(wanted, executor, Faults()):
        yield index, episode
        progress(1)


def run_suite(
    policy: AgentSpec,
    suite: Suite,
    *,
    executor: Executor | None = None,
    progress: Callable[[int], None] = lambda episodes: None,
    done: Mapping[int, Episode] | None = None,
    keep: Callable[[int, Episode], None] = lambda index, episode: None,
    shelf: Shelf | None = None,
    secret: bytes | None = None,
    channel: Channel | None = None,
) -> Run:
    """Evaluate a policy on a suite.

    The result depends on the policy and the suite only: not on the executor, its workers or the
    order in which they finish. Episodes that are lost with a worker are played again.

    Parameters
    ----------
    policy
        The policy's specification.
    suite
        The suite.
    executor
        Plays the batches; None plays them in this process.
    progress
        Called with the number of episodes that were finished since the last call.
    done
        Episodes of an earlier run by their place in the suite; they are not played again.
    keep
        Called with the place and the episode whenever an episode is finished and on the shelf.
    shelf
        Where finished episodes go, such as a journal; None is a :class:`.Spool`.
    secret
        Determines the order of the episodes; see :func:`.shuffled_batches`. None plays them in
        the suite's order.
    channel
        The channel between the robot and the policy; None is no channel.

    Returns
    -------
    Run
        All episodes.

    Raises
    ------
    InputError
        If the policy cannot be loaded, a channel would lead to a second person, or there is no
        engine.
    EvaluatorFault
        If the machine fails repeatedly; the finished episodes went to ``shelf`` and ``keep``.
    InterruptedRunError
        After Ctrl-C, even during the last episode; with the episodes that were finished by then.
    """
    require_engine()
    policy = placed(policy, executor)
    policy.check()
    found, shelf = dict(done or {}), shelf or Spool()
    if found:
        progress(len(found))
    faults = Faults()
    if secret is None:
        wanted = batches(policy, suite, found, channel)
    else:
        wanted = shuffled_batches(policy, suite, secret, found, channel)
    interrupted = False
    try:
        for index, episode in run_batches(wanted, executor, faults):
            found[index] = shelf.keep(index, episode)
            keep(index, found[index])
            progress(1)
    except KeyboardInterrupt:
        interrupted = True
    run = Run(
        policy=policy.name,
        policy_digest=policy.digest(),
        suite=suite,
        episodes=tuple(found[index] for index in sorted(found)),
        isolation=policy.isolation,
        faults=faults.count,
        channel=channel,
    )
    if interrupted:
        raise InterruptedRunError(run)
    return run
