"""Paired results whose comparison is known."""

import math

import numpy as np
import pytest
from colift.benchmark.comparison.compare import Comparison, compare
from colift.benchmark.comparison.paired_results import PairedResults, PolicyResults
from colift.benchmark.results.scores import ScoreTable
from colift.benchmark.results.summary import StepTimes
from colift.benchmark.suites.suite import make_suite
from colift.benchmark.tasks.level.table import LEVEL_METRICS
from colift.benchmark.tasks.level.task import BEHAVIOURS

SUBJECTS = tuple(f"P{i}" for i in range(1, 9))

CELLS = tuple(
    (behaviour, subject) for behaviour in BEHAVIOURS for subject in SUBJECTS for _ in range(2)
)
"""Two lifts of each of eight people on each behaviour."""

DIFFICULTY = np.array([6.0 if behaviour != "jerky" else 20.0 for behaviour, _ in CELLS])


def policy_results(name: str, rmse: object, sparc: object, failed: int = 0) -> PolicyResults:
    """Return a policy's scores; the first lifts failed."""
    errors = np.broadcast_to(np.asarray(rmse, dtype=float), len(CELLS))
    smoothness = np.broadcast_to(np.asarray(sparc, dtype=float), len(CELLS))
    given = {
        "rmse_mm": errors,
        "sparc": smoothness,
        "ldlj": -12.0,
        "human_force_n": 0.25,
        "robot_lag_ms": 100.0,
        "clipped": math.nan,
    }
    values = {
        metric: tuple(np.broadcast_to(given.get(metric, 0.0), len(CELLS)).tolist())
        for metric in LEVEL_METRICS
    }
    failures = tuple("step 3: oops" if i < failed else None for i in range(len(CELLS)))
    return PolicyResults(
        name=name,
        digest=f"digest of {name}",
        scores=ScoreTable(strata=CELLS, values=values, failures=failures),
        step_ms=StepTimes(p50=0.1, p99=0.2),
    )


def noise(seed: int, spread: float = 0.5) -> np.ndarray:
    """Return what differs from lift to lift; its mean is zero on every behaviour."""
    drawn = np.random.default_rng(seed).normal(0.0, spread, (4, 16))
    return (drawn - drawn.mean(axis=1, keepdims=True)).ravel()


def paired(*policies: PolicyResults) -> PairedResults:
    """Return results against a human-human baseline whose error is the difficulty of the lift."""
    means = {**dict.fromkeys(LEVEL_METRICS, 0.0), "sparc": -2.5, "human_force_n": 0.4}
    human_human = ScoreTable(strata=CELLS, values={"rmse_mm": tuple(DIFFICULTY)}, means=means)
    return PairedResults(suite=make_suite("quick-v1"), policies=policies, human_human=human_human)


@pytest.fixture(scope="session")
def comparison() -> Comparison:
    """A leader, one that cannot be told from it, a smooth follower, one still, one that fails."""
    leader = DIFFICULTY + 2.0 + noise(0)
    twin = leader + 0.01 + noise(1, 0.1)
    follower = DIFFICULTY + 5.0 + noise(2)
    # It wins on jerky lifts.
    follower = np.where(DIFFICULTY > 10.0, 18.0 + noise(3), follower)
    failing = np.full(len(CELLS), 30.0)
    failing[:3] = 250.0
    some = np.where(np.arange(len(CELLS)) < 3, np.nan, -1.2)
    return compare(
        paired(
            policy_results("still", 120.0 + noise(4), np.nan),
            policy_results("follower", follower, -1.5 + 0.1 * noise(5)),
            policy_results("leader", leader, -2.0 + 0.1 * noise(6)),
            policy_results("failing", failing, some, failed=3),
            policy_results("twin", twin, -2.1 + 0.1 * noise(7)),
        )
    )
