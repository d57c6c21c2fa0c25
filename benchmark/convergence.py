"""The convergence study behind the physics step."""

import itertools
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Final

import numpy as np

from ..agents.policies.loading import PolicySpec
from .episode import run_episode
from .lift import Lift
from .suite import make_suite
from .world import Physics

REFERENCE: Final = Physics(step=0.0005, iterations=200)
"""What the others are held against."""

STEPS: Final = (0.0025, 0.005, 0.01)
ITERATIONS: Final = (10, 20, 35, 50)
POLICIES: Final = ("copy", "random")
"""A policy that follows, and one that jerks the table."""


@dataclass(frozen=True, kw_only=True)
class Row:
    """One setting of the physics against the reference."""

    physics: Physics
    policy: str
    rmse_error: float
    """Largest relative error of an episode's RMSE."""
    mean_error: float
    """Relative error of the mean RMSE."""
    height_error_mm: float
    """Root mean square error of the two ends' heights [mm]."""


def study() -> Iterator[Row]:
    """Play ``quick-v1``'s first seeds at every setting and yield the errors, finest first."""
    for policy in POLICIES:
        exact_rmse, exact_heights = _play(policy, REFERENCE)
        for step, iterations in itertools.product(STEPS, ITERATIONS):
            physics = Physics(step=step, iterations=iterations)
            rmse, heights = _play(policy, physics)
            yield Row(
                physics=physics,
                policy=policy,
                rmse_error=float(np.max(np.abs(rmse / exact_rmse - 1))),
                mean_error=float(abs(rmse.mean() / exact_rmse.mean() - 1)),
                height_error_mm=1000 * float(np.sqrt(np.mean((heights - exact_heights) ** 2))),
            )


def _play(policy: str, physics: Physics) -> tuple[np.ndarray, np.ndarray]:
    """Return the RMSE of each episode and all heights, joined."""
    rmse, heights = [], []
    suite = make_suite("quick-v1")
    for scenario in suite.scenarios:
        lift = Lift(scenario, physics=physics)
        episode = run_episode(lift, PolicySpec(text=policy).make(), suite.seeds[0])
        lift.close()
        rmse.append(episode.scores.rmse_mm)
        heights += [episode.trace.human_end, episode.trace.robot_end]
    return np.array(rmse), np.concatenate(heights)
