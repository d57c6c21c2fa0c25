"""The convergence study behind the physics step and its solver."""

import contextlib
import dataclasses
from collections.abc import Iterator, Mapping, Sequence
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
    rmse_error: float
    """Largest relative error of an episode's RMSE."""
    mean_error: float
    """Relative error of the mean RMSE."""
    height_error_mm: float
    """Root mean square error of the two ends' heights [mm]."""


def study(name: str = USUAL) -> Iterator[PhysicsDeviation]:
    """Play the first seed of a suite with each policy and setting, and yield the errors.

    The solver is studied on :data:`USUAL` alone.

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
    for reference, settings in STUDIED.items():
        if reference is CONVERGED and name != USUAL:
            continue
        for policy in PLAYERS[task.name]:
            yield from physics_errors(suite, policy, reference, *settings)


def solver_error() -> float:
    """Return the worst relative RMSE error of a lift against a converged solver."""
    suite = make_suite(USUAL)
    rows = [row for policy in POLICIES for row in physics_errors(suite, policy, CONVERGED, PHYSICS)]
    return max(row.rmse_error for row in rows)


def physics_errors(
    suite: Suite, policy: str, reference: Physics, *settings: Physics
) -> Iterator[PhysicsDeviation]:
    """Yield the errors of settings on the first seed of a suite, with one policy."""
    exact_rmse, exact_heights = _play(suite, policy, reference)
    for physics in settings:
        rmse, heights = _play(suite, policy, physics)
        count = min(len(heights), len(exact_heights))
        yield PhysicsDeviation(
            physics=physics,
            reference=reference,
            policy=policy,
            rmse_error=float(np.max(np.abs(rmse / exact_rmse - 1))),
            mean_error=float(abs(rmse.mean() / exact_rmse.mean() - 1)),
            height_error_mm=1000
            * float(np.sqrt(np.mean((heights[:count] - exact_heights[:count]) ** 2))),
        )


def _play(
    suite: Suite, policy: str, physics: Physics
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Return the RMSE of each episode and all heights, joined."""
    rmse, heights = [], []
    for scenario in suite.scenarios:
        if policy == PAIR:
            scenario = dataclasses.replace(scenario, partner="human")
        spec = partner_spec(scenario.task) if policy == PAIR else PolicySpec(text=policy)
        with contextlib.closing(_lift(scenario, physics)) as lift, spec.agent() as agent:
            episode = run_episode(lift, agent, suite.seeds[0])
        rmse.append(episode.scores["rmse_mm"])
        heights += [episode.trace.human_end, episode.trace.robot_end]
    return np.array(rmse), np.concatenate(heights)


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
