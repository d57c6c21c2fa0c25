"""The deviation of the twin from the engine, lift by lift."""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from typing import Final

import numpy as np
from colift.agents.agent import Agent
from colift.agents.humans import SecondPerson
from colift.agents.loading.policy_spec import PolicySpec
from colift.benchmark.episode.lift import Lift
from colift.benchmark.episode.loop import run_episode
from colift.benchmark.episode.scenario import Scenario
from colift.benchmark.suites.catalogue import make_scenario
from colift.benchmark.tasks.level.task import BEHAVIOURS
from colift.benchmark.twin.agents import play_agents, play_pairs
from numpy.typing import NDArray

POLICIES: Final = ("copy", "proportional", "extrapolate", "anticipate", "learned")
"""One that follows, one that regulates, one that predicts a line, and two that were learned."""

PAIR: Final = "two humans"
"""Name of the human-human team."""

PEOPLE: Final = range(210_000, 210_010)
"""Seeds of people and lifts outside all suites, none of which is used for learning."""

MEAN_LIMIT: Final = 0.003
WORST_LIMIT: Final = 0.015
PAIR_LIMIT: Final = 0.005
"""Largest relative errors: of a mean RMSE, of a lift's, and of any mean or lift of two humans."""


@dataclass(frozen=True, kw_only=True)
class TwinDeviation:
    """The twin's errors for a policy."""

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
        return self.mean_error <= MEAN_LIMIT and self.worst_error <= WORST_LIMIT


def deviations() -> Iterator[TwinDeviation]:
    """Yield the deviation for each of :data:`POLICIES`, then that for two humans."""
    for name in POLICIES:
        yield policy_deviation(name)
    yield pair_deviation()


def policy_deviation(name: str, people: Sequence[int] = PEOPLE) -> TwinDeviation:
    """Return the deviation for a registered policy.

    Parameters
    ----------
    name
        Name of the policy.
    people
        Seeds: each person makes one lift of each behaviour.
    """
    lifts, spec = _lifts("nao", people), PolicySpec(text=name)
    return _deviation(name, _in_engine(spec.make, lifts), play_agents(spec.make, lifts))


def pair_deviation(people: Sequence[int] = PEOPLE) -> TwinDeviation:
    """Return the deviation for two humans."""
    lifts = _lifts("human", people)
    return _deviation(PAIR, _in_engine(SecondPerson, lifts), play_pairs(lifts))


def _lifts(partner: str, people: Sequence[int]) -> list[tuple[Scenario, int]]:
    return [
        (make_scenario(behaviour, f"draw-{seed}", partner), seed)
        for behaviour in BEHAVIOURS
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
    policy: str, engine: NDArray[np.float64], twin: NDArray[np.float64]
) -> TwinDeviation:
    return TwinDeviation(
        policy=policy,
        engine_mm=float(engine.mean()),
        twin_mm=float(twin.mean()),
        worst_error=float(np.abs(twin / engine - 1).max()),
    )
