"""Playing policies and two people on the lifts of sources and suites."""

from collections.abc import Callable, Mapping
from concurrent.futures import Executor

import numpy as np
from colift.agents.spec import AgentSpec
from colift.base.errors import InputError
from colift.benchmark.episode.metric import LEADING
from colift.benchmark.episode.seeding import derive_seed
from colift.benchmark.execution.runner import Run, run_suite
from colift.benchmark.results.baselines import (
    HUMAN_HUMAN,
    human_human_run,
    shipped_baselines,
)
from colift.benchmark.results.scores import ScoreTable
from colift.benchmark.statistics import FloatArray
from colift.benchmark.suites.suite import Suite
from colift.benchmark.tasks.level.task import LEVEL
from colift.benchmark.validity.beside_pairs import beside_pairs
from colift.benchmark.validity.scores import Scores
from colift.benchmark.validity.sources import Source

Known = Mapping[str, FloatArray]
"""Known RMSE of policies in each lift of a suite [mm], shape (n,)."""


def validity_lifts(policies: Mapping[str, AgentSpec], suite: Suite, known: Known) -> int:
    """Return the number of lifts that :func:`play_suite` will play."""
    missing = sum(name not in known for name in policies)
    return suite.size * (missing + (shipped_baselines(suite) is None))


def check_same_task(suite: Suite) -> None:
    """Raise an InputError if a suite has another task than real lifts have.

    Raises
    ------
    InputError
        If its task is not ``level``.
    """
    task = suite.scenarios[0].task.name
    if task != LEVEL.name:
        raise InputError(f"{suite.name} has the task {task}; real lifts have the task {LEVEL.name}")


def play_suite(
    policies: Mapping[str, AgentSpec],
    suite: Suite,
    known: Known,
    *,
    executor: Executor | None = None,
    progress: Callable[[int], None] = lambda lifts: None,
) -> Scores:
    """Return the scores of policies on a suite.

    Parameters
    ----------
    policies
        Policies, by the name that tables use.
    suite
        The suite.
    known
        Scores that need not be played.
    executor, progress
        As for :func:`.run_suite`.

    Raises
    ------
    InputError
        If a policy cannot be loaded.
    """
    shipped = shipped_baselines(suite)
    human_human = (
        ScoreTable.of(human_human_run(suite, executor=executor, progress=progress))
        if shipped is None
        else shipped[HUMAN_HUMAN]
    )
    there = {name: known[name] for name in policies if name in known}
    wanted = {name: spec for name, spec in policies.items() if name not in known}
    played = _play(wanted, suite, executor, progress)
    return Scores(
        name=suite.name,
        digest=suite.digest,
        units=human_human.units,
        errors={name: there[name] if name in there else _errors(played[name]) for name in policies},
        human_human=np.array(human_human.rmse_mm),
        seed=derive_seed(0, "validity suite"),
        shipped=tuple(there),
        failed=_failed(played),
    )


def play_source(
    policies: Mapping[str, AgentSpec],
    source: Source,
    *,
    executor: Executor | None = None,
    progress: Callable[[int], None] = lambda lifts: None,
) -> Scores:
    """Return the scores of policies on a source; arguments as for :func:`play_suite`.

    The people are those that the source names; without names, each recording stands alone. The
    simulated bodies, which take its lifts in turn, have no influence on this.
    """
    suite = source.suite
    two_people = human_human_run(suite, executor=executor, progress=progress)
    human_human = ScoreTable.of(two_people)
    played = _play(policies, suite, executor, progress)
    return Scores(
        name=source.name,
        digest=suite.digest,
        units=human_human.units,
        errors={name: _errors(run) for name, run in played.items()},
        human_human=np.array(human_human.rmse_mm),
        seed=derive_seed(0, "validity source"),
        beside=beside_pairs(
            suite, human_human.units, source.pairs, {**played, HUMAN_HUMAN: two_people}
        ),
        failed=_failed(played),
    )


def _play(
    policies: Mapping[str, AgentSpec],
    suite: Suite,
    executor: Executor | None,
    progress: Callable[[int], None],
) -> dict[str, Run]:
    return {
        name: run_suite(spec, suite, executor=executor, progress=progress)
        for name, spec in policies.items()
    }


def _errors(run: Run) -> FloatArray:
    return np.array([episode.scores[LEADING] for episode in run.episodes])


def _failed(runs: Mapping[str, Run]) -> dict[str, int]:
    counts = {
        name: sum(episode.failure is not None for episode in run.episodes)
        for name, run in runs.items()
    }
    return {name: count for name, count in counts.items() if count}
