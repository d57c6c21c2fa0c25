"""Runs a policy through a suite, alone or on any executor."""

import contextlib
from collections.abc import Callable, Mapping
from concurrent.futures import Executor
from dataclasses import dataclass

from .agent_spec import AgentSpec
from .episode import Episode
from .gathering import Faults, gather
from .suite import Suite
from .tasks import tasks


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
    """What kept the policy from the process that scores."""
    faults: int = 0
    """How often episodes had to be played again because the machine had failed."""

    @property
    def complete(self) -> bool:
        """Whether every episode of the suite is there."""
        return len(self.episodes) == self.suite.size


def run_suite(
    policy: AgentSpec,
    suite: Suite,
    *,
    executor: Executor | None = None,
    progress: Callable[[int], None] = lambda episodes: None,
    done: Mapping[int, Episode] | None = None,
    keep: Callable[[int, Episode], None] = lambda place, episode: None,
    key: bytes = b"",
) -> Run:
    """Evaluate a policy on a suite.

    The result depends on the policy and the suite only: not on the executor, its workers or the
    order in which they finish. What fails because a worker died is played again.

    Parameters
    ----------
    policy
        Where the policy's class is.
    suite
        The episodes.
    executor
        Runs the tasks, at most its own number at a time; None runs everything in this process.
    progress
        Called with the number of episodes that were finished since the last call.
    done
        Episodes of an earlier run by their place in the suite; they are not played again.
    keep
        Called with the place and the episode whenever one is finished.
    key
        The key of the policy's seed; see :func:`.policy_seed`.

    Returns
    -------
    Run
        All episodes; or, after Ctrl-C, those that were finished by then.

    Raises
    ------
    InputError
        If the policy cannot be loaded.
    EvaluatorFault
        If the machine fails again and again; what was finished went to ``keep``.
    """
    policy.check()
    found = dict(done or {})
    if found:
        progress(len(found))
    faults = Faults()
    with contextlib.suppress(KeyboardInterrupt):
        for place, episode in gather(tasks(policy, suite, found, key), executor, faults):
            found[place] = episode
            keep(place, episode)
            progress(1)
    return Run(
        policy=policy.name,
        policy_digest=policy.digest(),
        suite=suite,
        episodes=tuple(found[place] for place in sorted(found)),
        isolation=policy.isolation,
        faults=faults.count,
    )
