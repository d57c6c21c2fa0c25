"""The admission test of a suite: all policies, two people and the oracle, by each criterion."""

from collections.abc import Callable, Mapping, Sequence
from concurrent.futures import Executor
from dataclasses import dataclass
from typing import Final

import numpy as np
from colift.agents.loading.policy_spec import PolicySpec
from colift.agents.tasks.touch.touch_controller import TouchController
from colift.base.errors import InputError
from colift.base.registry import own_policies, policies_by_task
from colift.benchmark.admission.criteria import (
    Criterion,
    conventions,
    interaction,
    like_people,
    no_free_ride,
    person_means_mm,
    rank_changes,
    room,
)
from colift.benchmark.admission.published import PUBLISHED
from colift.benchmark.comparison.playing import known_references
from colift.benchmark.execution.runner import Run, run_suite
from colift.benchmark.references.catalogue import suite_references
from colift.benchmark.references.oracle import ORACLE
from colift.benchmark.results.baselines import HUMAN_HUMAN_LABEL, human_human_run
from colift.benchmark.results.scores import ScoreTable
from colift.benchmark.suites.suite import Suite
from numpy.typing import NDArray

KEEPERS: Final = ("copy", "extrapolate", "anticipate")
"""Policies that keep the table level, from the simplest to the best."""

HOLD: Final = "hold"
"""The policy that stands still."""


@dataclass(frozen=True, kw_only=True)
class Admission:
    """The result of the test."""

    suite: str
    digest: str
    means: Mapping[str, float]
    """Mean RMSE of each player: policies, two people and the oracle [mm]."""
    by_person: Mapping[str, Mapping[str, float]]
    """Mean RMSE of each player with each person [mm]."""
    criteria: tuple[Criterion, ...]

    @property
    def passed(self) -> bool:
        """Whether no criterion failed."""
        return all(each.passed is not False for each in self.criteria)


def players(task: str) -> tuple[str, ...]:
    """Return the names of all policies that the test plays: level-keepers, and the task's own."""
    own = own_policies(task)
    return (*KEEPERS, *(name for name in policies_by_task().get(task, ()) if name in own))


def trained(name: str) -> bool:
    """Return whether a policy is a network that was trained with the population of a suite."""
    return issubclass(PolicySpec(text=name).load(), TouchController)


def admission_of(
    suite: Suite,
    names: Sequence[str],
    *,
    pairs: NDArray[np.float64] | None = None,
    executor: Executor | None = None,
    progress: Callable[[int], None] = lambda episodes: None,
) -> Admission:
    """Test a suite; references that are shipped are not played again.

    Parameters
    ----------
    suite
        The suite.
    names
        The policies, :data:`KEEPERS` among them; see :func:`players`.
    pairs
        The result of :func:`.cross_play`; None if no pair was trained.
    executor, progress
        As for :func:`.run_suite`.

    Raises
    ------
    InputError
        If the suite's task has no oracle.
    """

    def played(name: str) -> Run:
        return run_suite(PolicySpec(text=name), suite, executor=executor, progress=progress)

    limits = suite_references(suite)
    if ORACLE not in limits:
        raise InputError(f"{suite.name} has lifts of a task without an oracle")
    references = known_references(limits, suite, executor=executor, progress=progress)
    human_human = human_human_run(suite, executor=executor, progress=progress)
    hold = played(HOLD)
    runs = {name: played(name) for name in names}
    published = PUBLISHED.get(suite.scenarios[0].task.name)
    playing = {HUMAN_HUMAN_LABEL: human_human, HOLD: hold, **runs}
    everybody = references | {name: ScoreTable.of(run) for name, run in playing.items()}
    return Admission(
        suite=suite.name,
        digest=suite.digest,
        means={name: each.mean for name, each in everybody.items()},
        by_person={name: person_means_mm(each) for name, each in everybody.items()},
        criteria=(
            room(
                references[ORACLE].mean,
                {name: run for name, run in runs.items() if name in KEEPERS},
            ),
            interaction(
                {name: run for name, run in runs.items() if not trained(name)},
                {name: run for name, run in runs.items() if trained(name)},
            ),
            rank_changes(runs),
            conventions(pairs),
            *([] if published is None else [like_people(human_human, published)]),
            no_free_ride(hold, human_human),
        ),
    )
