"""The convergence study behind the physics step and its solver."""

from collections.abc import Iterator, Mapping, Sequence
from concurrent.futures import Executor
from contextlib import closing
from dataclasses import dataclass, replace
from functools import partial
from typing import Final

import numpy as np
from colift.agents.loading.policy_spec import PolicySpec
from colift.base.errors import InputError
from colift.benchmark.episode.lift import Lift, MakeWorld
from colift.benchmark.episode.loop import run_episode
from colift.benchmark.episode.scenario import Scenario
from colift.benchmark.episode.task import Task
from colift.benchmark.episode.trace import Trace
from colift.benchmark.execution.pool import default_jobs, process_pool
from colift.benchmark.results.baselines import partner_spec
from colift.benchmark.suites.suite import Suite, make_suite
from colift.benchmark.world.physics import PHYSICS, Physics
from numpy.typing import NDArray

FINE: Final = Physics(step=0.0005)
"""The reference for the step."""

STEPS: Final = (Physics(step=0.0025), Physics(step=0.005), PHYSICS)
"""The settings compared with it."""

CONVERGED: Final = 3000
"""Iterations of the reference for the solver, at the task's step."""

ITERATIONS: Final = (35, 200, 0)
"""Iterations of the settings compared with it; 0 is the direct solver."""

POLICIES: Final = ("anticipate", "blend", "copy", "random")
"""Two that predict, one that follows, and one that jerks the table."""

PAIR: Final = "two people"
"""Name of the human-human team."""

PLAYERS: Final[Mapping[str, Sequence[str]]] = {
    "level": POLICIES,
    "intent": ("pose_bayes", "pose_admittance", PAIR),
    "agree": ("agree_game", "agree_admittance", PAIR),
    "ball": ("ball_game", "ball_calm", PAIR),
}
"""Players of the lifts of each task; for tasks with touch, a policy that infers the human's aim,
one that does not, and two people."""

USUAL: Final = "quick-v1"
"""The suite that is studied by default."""


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
    """Standard error of the mean error, from the differences of the same lifts."""
    height_error_mm: float
    """Root mean square error of the two ends' heights [mm]."""


def study(name: str = USUAL) -> Iterator[PhysicsDeviation]:
    """Play the lifts of a suite with each policy and setting, and yield the errors.

    The step is studied on all lifts, the solver at the step of the task on those of one seed.

    Raises
    ------
    InputError
        If the suite's task is not in :data:`PLAYERS`.
    """
    suite = make_suite(name)
    task = suite.scenarios[0].task
    if task.name not in PLAYERS:
        known = ", ".join(PLAYERS)
        raise InputError(f"{name} has the task {task.name!r}; convergence is studied for {known}")
    with process_pool(default_jobs()) as pool:
        for policy in PLAYERS[task.name]:
            yield from physics_errors(suite, policy, FINE, *STEPS, pool=pool)
        own = physics_of(task)
        reference, *others = (replace(own, iterations=n) for n in (CONVERGED, *ITERATIONS))
        for policy in PLAYERS[task.name]:
            yield from physics_errors(_one_seed(suite), policy, reference, *others, pool=pool)


def solver_error() -> float:
    """Return the worst relative RMSE error of a lift against a converged solver."""
    suite, reference = _one_seed(make_suite(USUAL)), replace(PHYSICS, iterations=CONVERGED)
    rows = [row for policy in POLICIES for row in physics_errors(suite, policy, reference, PHYSICS)]
    return max(row.worst_error for row in rows)


def physics_of(task: Task) -> Physics:
    """Return the physics with which a task is played."""
    return task.physics


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
    lifts = [(scenario, seed) for seed in suite.seeds for scenario in suite.scenarios]
    play = map if pool is None else pool.map
    exact = list(play(partial(_play, policy, reference), lifts))
    expected = _rmse(exact)
    for physics in settings:
        played = list(play(partial(_play, policy, physics), lifts))
        change = (_rmse(played) - expected) / expected.mean()
        spread = change.std(ddof=1) / np.sqrt(len(change)) if len(change) > 1 else np.nan
        errors = np.abs(_rmse(played) / expected - 1)
        yield PhysicsDeviation(
            physics=physics,
            reference=reference,
            policy=policy,
            worst_error=float(np.max(errors)),
            median_error=float(np.median(errors)),
            mean_error=float(change.mean()),
            mean_spread=float(spread),
            height_error_mm=1000 * _height_error(played, exact),
        )


def _one_seed(suite: Suite) -> Suite:
    return replace(suite, seeds=suite.seeds[:1])


def _rmse(played: Sequence[tuple[float, Trace]]) -> NDArray[np.float64]:
    """Return the RMSE of each lift [mm]."""
    return np.array([rmse for rmse, _ in played])


def _height_error(
    played: Sequence[tuple[float, Trace]], exact: Sequence[tuple[float, Trace]]
) -> float:
    """Return the root mean square difference of the ends' heights, over all frames [m]."""
    squares = []
    for (_, trace), (_, other) in zip(played, exact, strict=True):
        count = min(len(trace.human_end), len(other.human_end))
        squares.append((trace.human_end[:count] - other.human_end[:count]) ** 2)
        squares.append((trace.robot_end[:count] - other.robot_end[:count]) ** 2)
    return float(np.sqrt(np.mean(np.concatenate(squares))))


def _play(policy: str, physics: Physics, drawn: tuple[Scenario, int]) -> tuple[float, Trace]:
    """Return the RMSE [mm] of a lift, and its trace."""
    scenario, seed = drawn
    if policy == PAIR:
        scenario = replace(scenario, partner="human")
    spec = partner_spec(scenario) if policy == PAIR else PolicySpec(text=policy)
    with closing(_lift(scenario, physics)) as lift, spec.agent() as agent:
        episode = run_episode(lift, agent, seed)
    return episode.scores["rmse_mm"], episode.trace


def _lift(scenario: Scenario, physics: Physics) -> Lift:
    """Return the lift of a scenario in its task's world, but with another physics."""
    world: MakeWorld = partial(scenario.task.world, physics=physics)
    return Lift(scenario, world=world)
