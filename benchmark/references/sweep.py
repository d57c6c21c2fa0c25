"""The gain of a faster or better-informed robot: a sweep of latency and control period."""

from collections.abc import Callable, Iterator
from concurrent.futures import Executor
from dataclasses import dataclass
from typing import Final

import numpy as np
from colift.agents.loading.policy_spec import PolicySpec
from colift.agents.spec import AgentSpec
from colift.benchmark.execution.runner import Run, run_suite
from colift.benchmark.references.anticipation_spec import AnticipationSpec
from colift.benchmark.references.oracle import ORACLE, oracle_run
from colift.benchmark.results.baselines import human_human_run
from colift.benchmark.results.scores import ScoreTable
from colift.benchmark.suites.suite import Suite
from colift.benchmark.training.anticipation import ROUNDS, learn_anticipation
from colift.benchmark.training.data import Timing

LATENCIES: Final = (0.0, 0.05, 0.1, 0.15, 0.2)
"""Latencies at the paper's control period [s]."""

PERIODS: Final = (0.02, 0.04, 0.06, 0.08, 0.1)
"""Control periods at the suites' latency [s]."""

FIXED: Final = ("reactive", "blend")
"""Policies that are not learned anew for each timing: they have no parameters that depend on it."""

NAMES: Final = (*FIXED, "anticipate", ORACLE)


@dataclass(frozen=True, kw_only=True)
class Swept:
    """Mean scores with one timing."""

    policy: str
    latency: float
    """[s]"""
    control_period: float
    """[s]"""
    rmse_mm: float
    sparc: float


def timings() -> tuple[Timing, ...]:
    """Return the timings: a cross through the paper's."""
    across = [Timing(latency=latency) for latency in LATENCIES]
    along = [Timing(control_period=period) for period in PERIODS]
    return tuple(dict.fromkeys((*across, *along)))


def lifts_to_play(suite: Suite, lifts: int) -> int:
    """Return the number of lifts that :func:`sweep` plays, for a progress bar."""
    return len(timings()) * (ROUNDS * lifts + len(NAMES) * suite.size) + suite.size


def sweep(
    suite: Suite,
    *,
    lifts: int,
    executor: Executor | None = None,
    progress: Callable[[int], None] = lambda lifts: None,
) -> Iterator[Swept]:
    """Yield the scores of each policy and of the oracle at each timing.

    `anticipate` is learned for each timing, in the way and on the seeds of the shipped one, since
    the forecast depends on the timing. Learned from fewer lifts than the shipped one, it is
    somewhat worse than it could be; with about a hundred lifts it may even oscillate.

    Parameters
    ----------
    suite
        The episodes, at any timing; with seeds and people that are not used for learning.
    lifts
        Lifts of a round of learning, at each timing.
    executor, progress
        As for :func:`.run_suite`.
    """
    for timing in timings():
        timed = suite.with_timing(timing.latency, timing.control_period)
        *_, policy = learn_anticipation(
            lifts=lifts, rounds=ROUNDS, timing=timing, executor=executor, progress=progress
        )
        specs: list[AgentSpec] = [
            *(PolicySpec(text=name) for name in FIXED),
            AnticipationSpec(name="anticipate", model=policy.model),
        ]
        for spec in specs:
            run = run_suite(spec, timed, executor=executor, progress=progress)
            yield _mean(spec.name, run, timing)
        yield _mean(ORACLE, oracle_run(timed, executor=executor, progress=progress), timing)


def human_human_rmse(
    suite: Suite,
    *,
    executor: Executor | None = None,
    progress: Callable[[int], None] = lambda lifts: None,
) -> float:
    """Return the mean RMSE of two people [mm]; it does not depend on the timing."""
    run = human_human_run(suite, executor=executor, progress=progress)
    return ScoreTable.of(run).mean


def _mean(name: str, run: Run, timing: Timing) -> Swept:
    scores = ScoreTable.of(run)
    return Swept(
        policy=name,
        latency=timing.latency,
        control_period=timing.control_period,
        rmse_mm=scores.mean,
        sparc=float(np.nanmean(scores.values["sparc"])),
    )
