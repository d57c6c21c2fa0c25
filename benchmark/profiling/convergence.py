"""The convergence study behind the physics step and its solver."""

import contextlib
import dataclasses
from collections.abc import Iterator, Mapping, Sequence
from concurrent.futures import Executor
from dataclasses import dataclass
from functools import partial
from typing import Final

import numpy as np
from numpy.typing import NDArray

from ...agents.errors import InputError
from ...agents.loading.loading import PolicySpec
from ..episode.episode import run_episode
from ..episode.lift import Lift, MakeWorld, make_lift
from ..episode.scenario import Scenario
from ..execution.pool import default_jobs, process_pool
from ..results.baselines import partner_spec
from ..suites.suite import Suite, make_suite
from ..tasks.ball.task import BallSteering
from ..tasks.haptic import Haptic
from ..world import PHYSICS, BulletWorld, HapticWorld, Physics

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

PAIR: Final = "two humans"
"""Name of the human-human team."""

PLAYERS: Final[Mapping[str, Sequence[str]]] = {
    "level": POLICIES,
    "intent": ("pose_bayes", "pose_admittance", PAIR),
    "agree": ("agree_game", "agree_admittance", PAIR),
    "ball": ("ball_game", "ball_calm", PAIR),
}
"""Who plays the lifts of each task; with touch a policy that infers the human's aim, one that does
not, and two people."""

USUAL: Final = "quick-v1"
"""The suite whose lifts are studied unless another is asked for."""


@dataclass(frozen=True, kw_only=True)
class PhysicsDeviation:
    """Errors of one setting of the physics relative to a reference."""

    physics: Physics
    reference: Physics
    policy: str
    worst_error: float
    """Largest relative error of a lift's RMSE."""
    median_error: float
    """Median of the absolute relative errors of the lifts' RMSE."""
    mean_error: float
    """Relative error of the mean RMSE, signed."""
    mean_spread: float
    """Standard error of that, from the differences of the same lifts."""
    height_error_mm: float
    """Root mean square error of the two ends' heights [mm]."""


def study(name: str = USUAL) -> Iterator[PhysicsDeviation]:
    """Play the lifts of a suite with each policy and setting, and yield the errors.

    Of :data:`USUAL` one seed is played, and the solver is studied on it alone. A suite with
    decisions is played whole: there a small difference can change a lift much, and what has to
    converge is the mean.

    Raises
    ------
    InputError
        If the suite has another task than those of :data:`PLAYERS`.
    """
    suite = make_suite(name)
    task = suite.scenarios[0].task
    if task.name not in PLAYERS:
        known = ", ".join(PLAYERS)
        raise InputError(f"{name} has the task {task.name!r}; convergence is studied for {known}")
    if name == USUAL:
        suite = _one_seed(suite)
    with process_pool(default_jobs()) as pool:
        for reference, settings in STUDIED.items():
            if reference is CONVERGED and name != USUAL:
                continue
            for policy in PLAYERS[task.name]:
                yield from physics_errors(suite, policy, reference, *settings, pool=pool)


def solver_error() -> float:
    """Return the worst relative RMSE error of a lift against a converged solver."""
    suite = _one_seed(make_suite(USUAL))
    rows = [row for policy in POLICIES for row in physics_errors(suite, policy, CONVERGED, PHYSICS)]
    return max(row.worst_error for row in rows)


def physics_errors(
    suite: Suite,
    policy: str,
    reference: Physics,
    *settings: Physics,
    pool: Executor | None = None,
) -> Iterator[PhysicsDeviation]:
    """Yield the errors of settings on the lifts of a suite, with one policy.

    The lifts are played by ``pool``, or here if there is none.
    """
    exact_rmse, exact_heights = _play(suite, policy, reference, pool)
    for physics in settings:
        rmse, heights = _play(suite, policy, physics, pool)
        count = min(len(heights), len(exact_heights))
        change = (rmse - exact_rmse) / exact_rmse.mean()
        spread = change.std(ddof=1) / np.sqrt(len(change)) if len(change) > 1 else np.nan
        errors = np.abs(rmse / exact_rmse - 1)
        yield PhysicsDeviation(
            physics=physics,
            reference=reference,
            policy=policy,
            worst_error=float(np.max(errors)),
            median_error=float(np.median(errors)),
            mean_error=float(change.mean()),
            mean_spread=float(spread),
            height_error_mm=1000
            * float(np.sqrt(np.mean((heights[:count] - exact_heights[:count]) ** 2))),
        )


def _one_seed(suite: Suite) -> Suite:
    return dataclasses.replace(suite, seeds=suite.seeds[:1])


def _play(
    suite: Suite, policy: str, physics: Physics, pool: Executor | None
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Return the RMSE of each lift and all heights, joined."""
    scenarios = [scenario for _ in suite.seeds for scenario in suite.scenarios]
    seeds = [seed for seed in suite.seeds for _ in suite.scenarios]
    play = map if pool is None else pool.map
    played = list(play(partial(_play_lift, policy, physics), scenarios, seeds))
    return np.array([rmse for rmse, _ in played]), np.concatenate([seen for _, seen in played])


def _play_lift(
    policy: str, physics: Physics, scenario: Scenario, seed: int
) -> tuple[float, NDArray[np.float64]]:
    """Return the RMSE [mm] of a lift, and the heights of both ends, joined [m]."""
    if policy == PAIR:
        scenario = dataclasses.replace(scenario, partner="human")
    spec = partner_spec(scenario.task) if policy == PAIR else PolicySpec(text=policy)
    with contextlib.closing(_lift(scenario, physics)) as lift, spec.agent() as agent:
        episode = run_episode(lift, agent, seed)
    trace = episode.trace
    return episode.scores["rmse_mm"], np.concatenate((trace.human_end, trace.robot_end))


def _lift(scenario: Scenario, physics: Physics) -> Lift:
    """Return the lift of a scenario in its task's world, but with another physics."""
    task = scenario.task
    world: MakeWorld = partial(BulletWorld, physics=physics)
    if isinstance(task, BallSteering):
        world = partial(HapticWorld, physics=physics, ball=task.ball)
    elif isinstance(task, Haptic):
        world = partial(HapticWorld, physics=physics)
    with contextlib.closing(make_lift(scenario)) as usual:
        return type(usual)(scenario, world=world)
