"""References that are told what a policy has to find out: the sensor's delays, and the person.

They are not policies: no robot is told these things. The difference between the error of a network
that is told and that of the same network that is not is what there is to infer.
"""

from collections.abc import Callable
from concurrent.futures import Executor
from dataclasses import dataclass
from functools import cache
from importlib.resources import files
from typing import Final

import numpy as np
from colift.agents.agent import Action, Observation
from colift.agents.control.portable import PORTABLE
from colift.agents.control.recurrent import GatedNetwork, act, memory_at_rest
from colift.base.errors import InputError
from colift.base.identity import code_hash
from colift.benchmark.episode.kept_world import drop_kept_world, lift_in_kept_world
from colift.benchmark.episode.loop import Episode, run_episode
from colift.benchmark.episode.scenario import Scenario
from colift.benchmark.execution.runner import Run
from colift.benchmark.suites.suite import Suite
from colift.benchmark.tasks.robust.telling import Telling, is_conditioned
from colift.benchmark.training.told_network import ToldNetwork, read_told
from numpy.typing import NDArray

TOLD: Final = "told"
"""Name of the shipped reference that is told both."""

Array = NDArray[np.float64]


class ToldController:
    """The control of a told network in one lift.

    Parameters
    ----------
    network
        The weights, in double precision.
    numbers
        (steps + 1, k) what it is told at the beginning of each step.
    """

    def __init__(self, network: GatedNetwork, numbers: Array) -> None:
        self._network, self._numbers = network, numbers

    def reset(self, seed: int) -> None:
        """Begin an episode."""
        self._memory, self._step = memory_at_rest(self._network), 0

    def act(self, observation: Observation) -> Action:
        """Return the change of the command [m]."""
        told = self._numbers[self._step]
        self._memory, change = act(self._network, self._memory, observation, PORTABLE, told)
        self._step += 1
        return np.array([change])


@dataclass(frozen=True, kw_only=True)
class ToldLift:
    """A lift with a told network, for a worker process."""

    told: ToldNetwork
    scenario: Scenario
    seed: int

    def __call__(self) -> Episode:
        """Return the episode."""
        with lift_in_kept_world(self.scenario) as lift:
            lift.reset(self.seed)
            assert lift.conditions is not None
            numbers = self.told.telling.numbers(self.scenario, lift.conditions)
            return run_episode(lift, ToldController(self.told.network, numbers), self.seed)


def play_told(
    told: ToldNetwork,
    suite: Suite,
    name: str = TOLD,
    *,
    executor: Executor | None = None,
    progress: Callable[[int], None] = lambda episodes: None,
) -> Run:
    """Return the run of a told network on a suite with conditions.

    Parameters
    ----------
    told, suite
        Network and suite.
    name
        Name of the run's policy.
    executor, progress
        As for :func:`.run_suite`.

    Raises
    ------
    InputError
        If the suite has no conditions.
    """
    if not all(is_conditioned(each) for each in suite.scenarios):
        raise InputError(
            f"{suite.name} has no conditions of a level table: nobody can be told them"
        )
    tasks = [
        ToldLift(told=told, scenario=scenario, seed=seed)
        for scenario in suite.scenarios
        for seed in suite.seeds
    ]
    play, episodes = ToldLift.__call__, []
    played = map(play, tasks) if executor is None else executor.map(play, tasks, chunksize=5)
    try:
        for each in played:
            episodes.append(each)
            progress(1)
    finally:
        drop_kept_world()
    digest = code_hash(ToldController, Telling)
    return Run(policy=name, policy_digest=digest, suite=suite, episodes=tuple(episodes))


@cache
def shipped() -> tuple[ToldNetwork, ...]:
    """Return the networks that are shipped, one for each conditions."""
    folder = files(__package__).joinpath("data")
    found = (file for file in folder.iterdir() if file.name.startswith("told_"))
    return tuple(map(read_told, sorted(found, key=lambda file: file.name)))


def told_of(suite: Suite) -> ToldNetwork | None:
    """Return the shipped network for the conditions of a suite; None if there is none."""
    every = {scenario.conditions for scenario in suite.scenarios}
    return next((each for each in shipped() if every == {each.conditions}), None)


def told_run(
    suite: Suite,
    *,
    executor: Executor | None = None,
    progress: Callable[[int], None] = lambda episodes: None,
) -> Run:
    """Return the run of the shipped told network on a suite; see :func:`play_told`.

    Raises
    ------
    InputError
        If no network was trained for the suite's conditions.
    """
    told = told_of(suite)
    if told is None:
        raise InputError(f"no reference was told the conditions of {suite.name}")
    return play_told(told, suite, executor=executor, progress=progress)
