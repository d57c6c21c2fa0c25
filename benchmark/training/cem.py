"""The cross-entropy method: a small network, trained on lifts in the engine, with NumPy alone.

In each generation, candidates are drawn from a normal distribution over the weights, all play the
same new lifts, and the distribution moves to the best of them (S. Mannor, R. Rubinstein, Y. Gat,
"The cross entropy method for fast policy search", ICML 2003).
"""

import time
from collections.abc import Callable
from concurrent.futures import Executor
from dataclasses import dataclass
from functools import partial
from typing import Final

import numpy as np
from colift.agents.submissions.network.policy import FIXED, Policy
from colift.base.errors import InputError
from colift.benchmark.training.course import Course, Point
from colift.benchmark.training.result import Weights, checked_network, write_policy
from colift.benchmark.training.validation import (
    LEARNING_SEEDS,
    MakeAgent,
    lift_errors,
    validation_error,
)
from numpy.typing import NDArray

NAME: Final = "cem"

Array = NDArray[np.float64]


@dataclass(frozen=True, kw_only=True)
class CemSettings:
    """Settings of a training.

    Raises
    ------
    InputError
        If one is out of range.
    """

    generations: int = 20
    """Number of generations. The distribution moves in each."""
    population: int = 40
    """Candidates per generation."""
    elite: int = 10
    """Best candidates, on which the next are modelled."""
    lifts: int = 12
    """Lifts per generation. They are the same for all candidates."""
    steps: int = 6
    """Steps of the human's motion that the network sees."""
    hidden: int = 2
    """Its tanh units."""
    inertia: float = 0.2
    """Share of the old distribution in the new one."""
    noise: float = 0.1
    """Deviation added to the elite's in the first generation, relative to the initial one; it falls
    to zero, and keeps the distribution from narrowing too early on a few lifts."""

    def __post_init__(self) -> None:
        """Check the ranges."""
        for name in ("generations", "population", "elite", "lifts", "steps", "hidden"):
            if getattr(self, name) < 1:
                raise InputError(f"{name} must be at least 1, got {getattr(self, name)}")
        if self.lifts > len(LEARNING_SEEDS):
            raise InputError(f"lifts must be at most {len(LEARNING_SEEDS)}, got {self.lifts}")
        if self.elite >= self.population:
            raise InputError(f"elite must be below population, {self.population}, got {self.elite}")


def train_cem(
    settings: CemSettings,
    course: Course,
    *,
    executor: Executor | None = None,
    progress: Callable[[int], None] = lambda lifts: None,
) -> None:
    """Train a policy and write it into the folder of the course; resume it if it was interrupted.

    The weights follow from settings and seed, whatever the executor.

    Parameters
    ----------
    settings, course
        Settings of the training, and the folder for its results.
    executor
        Plays the lifts; None plays them in this process.
    progress
        Called with the number of lifts, for all candidates, that were finished since the last call.

    Raises
    ------
    InputError
        If the course cannot be resumed, or a file cannot be written.
    """
    mean, initial = start(settings, course.seed)
    deviation, first = initial, 0
    state = course.load({"mean": mean.shape, "deviation": mean.shape, "generation": ()})
    if state is not None:
        mean, deviation, first = state["mean"], state["deviation"], int(state["generation"])
        progress(first * settings.lifts)
    begin = time.perf_counter() - course.seconds
    steps = course.steps
    for generation in range(first, settings.generations):
        rng = np.random.default_rng([course.seed, generation])
        candidates = rng.normal(mean, deviation, (settings.population, len(mean)))
        lifts = rng.choice(LEARNING_SEEDS, settings.lifts, replace=False).tolist()
        policies = [policy(settings, each) for each in candidates]
        errors, played = lift_errors(policies, lifts, executor, progress)
        best = candidates[np.argsort(errors.mean(axis=1), kind="stable")[: settings.elite]]
        extra = settings.noise * (1 - (generation + 1) / settings.generations) * initial
        keep = settings.inertia
        mean = keep * mean + (1 - keep) * best.mean(axis=0)
        deviation = keep * deviation + (1 - keep) * np.hypot(best.std(axis=0), extra)
        steps += played

        error = validation_error(policy(settings, mean), executor)
        course.keep(
            Point(steps, time.perf_counter() - begin, error),
            {"mean": mean, "deviation": deviation, "generation": np.array(generation + 1)},
        )
    write_policy(
        course,
        unpack(settings, mean),
        {
            "description": f"A straight line through the human's last heights, corrected by a "
            f"network of {settings.hidden} units, trained by the cross-entropy method.",
            "trained_on": f"{settings.generations * settings.lifts} lifts of colift with drawn "
            f"people, seeds {LEARNING_SEEDS[0]} to {LEARNING_SEEDS[-1]}.",
        },
    )


def start(settings: CemSettings, seed: int) -> tuple[Array, Array]:
    """Return mean and deviation of the first distribution.

    On average it does not correct the line at all: the hidden units are drawn and their outputs
    zero. A deviation of 0.2 in a linear weight is a lead of 30 ms.
    """
    rng = np.random.default_rng([seed, 10**6])
    inputs = FIXED + settings.steps
    parts = {
        "linear": (np.zeros(inputs), 0.2),
        "w0": (rng.normal(0.0, 1.0, (settings.hidden, inputs)), 0.5),
        "b0": (rng.normal(0.0, 0.5, settings.hidden), 0.5),
        "w1": (np.zeros((1, settings.hidden)), 0.2),
        "b1": (np.zeros(1), 0.02),
    }
    mean = np.concatenate([value.ravel() for value, _ in parts.values()])
    return mean, np.concatenate([np.full(value.size, size) for value, size in parts.values()])


def unpack(settings: CemSettings, parameters: Array) -> Weights:
    """Return the weights of the network of a vector of parameters."""
    inputs, hidden = FIXED + settings.steps, settings.hidden
    shapes = {
        "linear": (inputs,),
        "w0": (hidden, inputs),
        "b0": (hidden,),
        "w1": (1, hidden),
        "b1": (1,),
    }
    ends = np.cumsum([np.prod(shape) for shape in shapes.values()])
    pieces = np.split(parameters, ends[:-1])
    return {
        name: piece.reshape(shape)
        for (name, shape), piece in zip(shapes.items(), pieces, strict=True)
    }


def policy(settings: CemSettings, parameters: Array) -> MakeAgent:
    """Return a function that makes the policy of a vector of parameters.

    Raises
    ------
    InputError
        If a parameter is not finite.
    """
    return partial(Policy, checked_network(unpack(settings, parameters)))
