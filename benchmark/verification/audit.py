"""The audit of a run: sampled episodes are played again, and their actions compared."""

from collections.abc import Callable, Sequence
from concurrent.futures import Executor
from dataclasses import dataclass
from typing import Final

import numpy as np
from colift.agents.spec import AgentSpec
from colift.benchmark.episode.loop import Episode
from colift.benchmark.execution.batches import Batch, Faults, run_batches
from colift.benchmark.execution.runner import Run, placed
from colift.benchmark.suites.hidden import keyed
from colift.benchmark.suites.suite import Suite

AUDIT: Final = "audit"
"""Name of the instance of a sandboxed policy that is played again."""

SAMPLES: Final = 10
"""Episodes that are played again. A policy that differs in a fraction q of all episodes passes
with probability (1 - q)^10: 0.1 % for a half."""

RULE: Final = (
    "its actions must follow from its seed and from what it sees in the lift alone, "
    "not from chance, from the time or from other lifts"
)
"""The rule that a policy breaks whose actions differ."""


@dataclass(frozen=True, kw_only=True)
class Deviation:
    """An episode whose actions differed when it was played again."""

    index: int
    """The place of the episode in the suite, counted from 0."""
    step: int
    """The first step whose action differs, or that only one of the two episodes has."""

    def describe(self, run: Run) -> str:
        """Return the finding in a line. It names the episode: do not use it for hidden ones."""
        episode = run.episodes[self.index]
        where = f"{episode.behaviour}/{episode.subject} seed {episode.seed}"
        return f"played again, {where} differs from step {self.step} on: {RULE}"


def audit(
    policy: AgentSpec,
    run: Run,
    secret: bytes,
    *,
    executor: Executor | None = None,
    progress: Callable[[int], None] = lambda episodes: None,
    keep: Callable[[int, Episode], None] = lambda index, episode: None,
) -> Deviation | None:
    """Play some of a run's episodes again, in another order; all actions must have equal bits.

    The secret chooses the episodes and their order, so that no policy can know them. One that
    differs because it failed is played a third time.

    Parameters
    ----------
    policy
        The policy of the run, loaded again: in a sandbox, as another instance (:data:`AUDIT`).
    run
        The complete run.
    secret
        The board's secret.
    executor, progress, keep
        As for :func:`.run_suite`; ``progress`` counts up to :func:`audited`.

    Returns
    -------
    Deviation or None
        The first episode of the suite that differs; None if all are equal.

    Raises
    ------
    EvaluatorFault
        If the machine failed; see :func:`.run_batches`.
    """
    indices = sampled(run, secret)
    again = _again(policy, run, indices, executor, keep, progress)
    for index in sorted(indices):
        first, second = run.episodes[index], again[index]
        step = first_differing_step(first, second)
        if step is None:
            continue
        if second.failure is not None:
            third = _again(policy, run, [index], executor, keep)[index]
            if first_differing_step(first, third) is None:
                continue  # The second episode ran out of time because the machine was busy.
        return Deviation(index=index, step=step)
    return None


def audited(episodes: int) -> int:
    """Return the number of episodes that are played again, of ``episodes`` in a suite."""
    return min(SAMPLES, episodes)


def sampled(run: Run, secret: bytes) -> list[int]:
    """Return the places of the episodes to play again, in the order of playing."""
    labels = ("audit", run.policy_digest, run.suite.digest)

    def lot(index: int) -> bytes:
        return keyed(secret, *labels, index)

    indices = sorted(range(len(run.episodes)), key=lot)
    return indices[: audited(len(indices))]


def first_differing_step(episode: Episode, again: Episode) -> int | None:
    """Return the first step in which two episodes' actions differ in a bit, or None.

    If the first episode failed, only common steps are compared: a failure is never an advantage.
    """
    first, second = (np.ascontiguousarray(each.trace.action) for each in (episode, again))
    steps = min(len(first), len(second))
    equal = (first[:steps].view(np.uint64) == second[:steps].view(np.uint64)).all(axis=1)
    if not equal.all():
        return int(equal.argmin())
    same = len(first) == len(second) or episode.failure is not None
    return None if same else steps


def _again(
    policy: AgentSpec,
    run: Run,
    indices: Sequence[int],
    executor: Executor | None,
    keep: Callable[[int, Episode], None],
    progress: Callable[[int], None] = lambda episodes: None,
) -> dict[int, Episode]:
    """Play the episodes at the places again, each as a separate task, in that order.

    Of a session all lifts are played up to the last that is wanted.
    """
    there, found = placed(policy, executor), {}
    wanted = [_batch(there, run.suite, index) for index in indices]
    for index, episode in run_batches(wanted, executor, Faults()):
        found[index] = episode
        keep(index, episode)
        progress(1)
    return found


def _batch(policy: AgentSpec, suite: Suite, place: int) -> Batch:
    """Return the lift at a place, after those of its session before."""
    first = place - place % suite.session if suite.session else place
    before = range(first, place)
    lifts = tuple(suite.at(each) for each in (*before, place))
    return Batch(policy=policy, lifts=lifts, done=frozenset(before))
