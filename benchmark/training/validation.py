"""The error of policies in the engine, on lifts with people who are not used for learning."""

from collections.abc import Callable, Sequence
from concurrent.futures import Executor
from functools import partial
from typing import Final

import numpy as np
from colift.agents.agent import Agent
from colift.base.errors import InputError
from colift.benchmark.environment.drawing import TRAINING_SEEDS
from colift.benchmark.episode.lift import Lift
from colift.benchmark.episode.metrics import rmse_mm
from colift.benchmark.tasks.level.task import BEHAVIOURS
from colift.benchmark.training.data import Timing, scenario
from colift.benchmark.world.interface import since_reset
from numpy.typing import NDArray

Array = NDArray[np.float64]

LEARNING_SEEDS: Final = TRAINING_SEEDS[:90_000]
"""Seeds of the people and lifts from which trainers learn."""

VALIDATION_SEEDS: Final = TRAINING_SEEDS[90_000:90_040]
"""Seeds of the people and lifts of a curve: ten of each behaviour."""


FEWEST: Final = 2
"""Fewest lifts, or sessions, to learn from."""


def learning_seeds(count: int, first: int = LEARNING_SEEDS[0]) -> range:
    """Return the seeds of ``count`` lifts to learn from.

    Raises
    ------
    InputError
        If there are fewer than :data:`FEWEST`, or a seed is not for learning.
    """
    low, high = LEARNING_SEEDS[0], LEARNING_SEEDS[-1]
    if not (count >= FEWEST and low <= first and first + count - 1 <= high):
        raise InputError(
            f"learning needs at least {FEWEST} lifts, with seeds {low} to {high}; got {count} from "
            f"seed {first}"
        )
    return range(first, first + count)


MakeAgent = Callable[[], Agent]


def lift_errors(
    policies: Sequence[MakeAgent],
    seeds: Sequence[int],
    executor: Executor | None = None,
    progress: Callable[[int], None] = lambda lifts: None,
) -> tuple[Array, int]:
    """Return the RMSE of each policy in each lift (policies, lifts) [mm], and the steps of all.

    Parameters
    ----------
    policies
        The policies, which all play the same lifts.
    seeds
        Seeds of the lifts.
    executor
        Plays the lifts; None plays them in this process, with the same result.
    progress
        Called with the number of lifts that all have played since the last call.
    """
    together = partial(lift_together, policies)
    errors, steps = [], 0
    done = map(together, seeds) if executor is None else executor.map(together, seeds)
    for error, length in done:
        errors.append(error)
        steps += length * len(policies)
        progress(1)
    return np.array(errors).T, steps


def lift_together(policies: Sequence[MakeAgent], seed: int) -> tuple[list[float], int]:
    """Return the RMSE of each policy in the lift of a seed [mm], and the steps of a lift.

    The person is also drawn by the seed. A dropped table counts as in the score.
    """
    lift = Lift(scenario(seed, BEHAVIOURS, Timing()))
    errors = []
    for make in policies:
        lift.reset(seed)
        human, robot = lift.scripted_human(), make()
        robot.reset(0)
        while not lift.done:
            action = robot.act(lift.partner_observation())
            lift.step(human.act(lift.human_observation()), action)
        ends = since_reset(lift.world.human_end), since_reset(lift.world.robot_end)
        errors.append(rmse_mm(*ends, horizon=lift.horizon))
    lift.close()
    return errors, lift.horizon // lift.frames_per_step


def validation_error(policy: MakeAgent, executor: Executor | None = None) -> float:
    """Return the mean RMSE of a policy on the validation lifts [mm]."""
    errors, _ = lift_errors([policy], VALIDATION_SEEDS, executor)
    return float(errors.mean())
