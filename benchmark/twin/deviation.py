"""The deviation of the twin from the engine, lift by lift."""

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from types import MappingProxyType
from typing import Final

import numpy as np
from colift.agents.agent import Agent
from colift.agents.humans import SecondPerson
from colift.agents.loading.policy_spec import PolicySpec
from colift.benchmark.episode.lift import Lift
from colift.benchmark.episode.loop import run_episode
from colift.benchmark.episode.scenario import Scenario
from colift.benchmark.suites.catalogue import make_scenario, make_task
from colift.benchmark.tasks.level.task import LEVEL
from colift.benchmark.twin.agents import play_agents, play_pairs
from numpy.typing import NDArray

POLICIES: Final[Mapping[str, tuple[str, ...]]] = MappingProxyType(
    {
        "level": ("copy", "proportional", "extrapolate", "anticipate", "learned"),
        "agree": ("agree_follower", "agree_learned"),
        "ball": ("ball_steady", "ball_learned"),
        "intent": ("touch_level", "pose_learned"),
    }
)
"""For each task, policies that are fixed, and at least one that was learned."""

PAIR: Final = "two people"
"""Name of the human-human team."""

PEOPLE: Final = range(210_000, 210_010)
"""Seeds of people and lifts outside all suites, none of which is used for learning."""

SOME: Final = PEOPLE[:4]
"""Those of the tasks with touch."""

MEAN_LIMIT: Final = 0.001
WORST_LIMIT: Final = 0.01
PAIR_LIMIT: Final = 0.005
"""Largest relative errors: of a mean RMSE, of a lift's, and of any mean or lift of two humans."""

AMPLIFYING: Final = ("agree_learned", "ball_learned", "pose_learned")
"""Policies that amplify differences of touch: in the engine, too, other steps of the physics change
single lifts by several per cent (``colift bench --convergence``)."""

AMPLIFIED_LIMIT: Final = 0.01
"""Largest relative error of their mean RMSE; single lifts have none."""


@dataclass(frozen=True, kw_only=True)
class TwinDeviation:
    """The twin's errors for a policy."""

    task: str
    policy: str
    engine_mm: float
    """Mean RMSE in the engine [mm]."""
    twin_mm: float
    """Mean RMSE in the twin [mm]."""
    worst_error: float
    """Largest error of a lift's RMSE, relative."""

    @property
    def mean_error(self) -> float:
        """Error of the mean RMSE, relative."""
        return abs(self.twin_mm / self.engine_mm - 1)

    @property
    def within_limits(self) -> bool:
        """Whether both errors are within their limits."""
        if self.policy == PAIR:
            return max(self.mean_error, self.worst_error) <= PAIR_LIMIT
        if self.policy in AMPLIFYING:
            return self.mean_error <= AMPLIFIED_LIMIT
        return self.mean_error <= MEAN_LIMIT and self.worst_error <= WORST_LIMIT


def deviations() -> Iterator[TwinDeviation]:
    """Yield the deviation for each of :data:`POLICIES`, and that for two humans."""
    for task, names in POLICIES.items():
        for name in names:
            yield policy_deviation(name, task, PEOPLE if task == LEVEL.name else SOME)
        if task == LEVEL.name:
            yield pair_deviation()


def policy_deviation(
    name: str, task: str = LEVEL.name, people: Sequence[int] = PEOPLE
) -> TwinDeviation:
    """Return the deviation for a registered policy.

    Parameters
    ----------
    name
        Name of the policy.
    task
        Name of the task.
    people
        Seeds: each person makes one lift of each behaviour.
    """
    lifts, spec = _lifts("nao", task, people), PolicySpec(text=name)
    engine, twin = _in_engine(spec.make, lifts), play_agents(spec.make, lifts)
    return _deviation(task, name, engine, twin)


def pair_deviation(people: Sequence[int] = PEOPLE) -> TwinDeviation:
    """Return the deviation for two humans."""
    lifts = _lifts("human", LEVEL.name, people)
    return _deviation(LEVEL.name, PAIR, _in_engine(SecondPerson, lifts), play_pairs(lifts))


def _lifts(partner: str, task: str, people: Sequence[int]) -> list[tuple[Scenario, int]]:
    return [
        (make_scenario(behaviour, f"draw-{seed}", partner, task=task), seed)
        for behaviour in make_task(task).behaviours
        for seed in people
    ]


def _in_engine(
    make: Callable[[], Agent], lifts: Sequence[tuple[Scenario, int]]
) -> NDArray[np.float64]:
    errors = []
    for scenario, seed in lifts:
        lift = Lift(scenario)
        errors.append(run_episode(lift, make(), seed).scores["rmse_mm"])
        lift.close()
    return np.array(errors)


def _deviation(
    task: str, policy: str, engine: NDArray[np.float64], twin: NDArray[np.float64]
) -> TwinDeviation:
    return TwinDeviation(
        task=task,
        policy=policy,
        engine_mm=float(engine.mean()),
        twin_mm=float(twin.mean()),
        worst_error=float(np.abs(twin / engine - 1).max()),
    )
