"""The convergence study behind the physics step and its solver."""

from collections.abc import Iterator
from dataclasses import dataclass
from functools import partial
from typing import Final

import numpy as np
from numpy.typing import NDArray

from ...agents.loading.loading import PolicySpec
from ..episode.episode import run_episode
from ..episode.lift import Lift
from ..suites.suite import make_suite
from ..world import PHYSICS, BulletWorld, Physics

FINE: Final = Physics(step=0.0005)
"""The reference for the step."""

CONVERGED: Final = Physics(iterations=3000)
"""The reference for the solver: another one, at the same step, with iterations to spare."""

STUDIED: Final = {
    FINE: (Physics(step=0.0025), Physics(step=0.005), PHYSICS),
    CONVERGED: (Physics(iterations=35), Physics(iterations=200), PHYSICS),
}
"""Each reference with the settings compared with it."""

POLICIES: Final = ("anticipate", "blend", "copy", "random")
"""Two that predict, one that follows, and one that jerks the table."""


@dataclass(frozen=True, kw_only=True)
class PhysicsDeviation:
    """Errors of one setting of the physics relative to a reference."""

    physics: Physics
    reference: Physics
    policy: str
    rmse_error: float
    """Largest relative error of an episode's RMSE."""
    mean_error: float
    """Relative error of the mean RMSE."""
    height_error_mm: float
    """Root mean square error of the two ends' heights [mm]."""


def study() -> Iterator[PhysicsDeviation]:
    """Play the first seed of ``quick-v1`` with each policy and setting, and yield the errors."""
    for reference, settings in STUDIED.items():
        for policy in POLICIES:
            yield from _errors(policy, reference, *settings)


def solver_error() -> float:
    """Return the worst relative RMSE error of a lift against a converged solver."""
    rows = [row for policy in POLICIES for row in _errors(policy, CONVERGED, PHYSICS)]
    return max(row.rmse_error for row in rows)


def _errors(policy: str, reference: Physics, *settings: Physics) -> Iterator[PhysicsDeviation]:
    exact_rmse, exact_heights = _play(policy, reference)
    for physics in settings:
        rmse, heights = _play(policy, physics)
        yield PhysicsDeviation(
            physics=physics,
            reference=reference,
            policy=policy,
            rmse_error=float(np.max(np.abs(rmse / exact_rmse - 1))),
            mean_error=float(abs(rmse.mean() / exact_rmse.mean() - 1)),
            height_error_mm=1000 * float(np.sqrt(np.mean((heights - exact_heights) ** 2))),
        )


def _play(policy: str, physics: Physics) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Return the RMSE of each episode and all heights, joined."""
    rmse, heights = [], []
    suite = make_suite("quick-v1")
    for scenario in suite.scenarios:
        lift = Lift(scenario, world=partial(BulletWorld, physics=physics))
        episode = run_episode(lift, PolicySpec(text=policy).make(), suite.seeds[0])
        lift.close()
        rmse.append(episode.scores["rmse_mm"])
        heights += [episode.trace.human_end, episode.trace.robot_end]
    return np.array(rmse), np.concatenate(heights)
