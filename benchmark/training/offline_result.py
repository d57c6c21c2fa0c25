"""The end of an offline training: the policy as a submission, and its error in the engine."""

import shutil
from collections.abc import Mapping
from concurrent.futures import Executor
from functools import partial
from importlib.resources import files
from io import BytesIO
from pathlib import Path
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from ...agents.errors import InputError
from ...agents.submissions import offline
from ...agents.submissions.new import write_files
from ...agents.submissions.offline.policy import Network, Policy
from ..environment.drawing import TRAINING_SEEDS
from ..episode.episode import run_episode
from ..episode.lift import Lift
from ..suites.suite import BEHAVIOURS
from .course import Course, replace_folder, write_whole
from .data import Timing, scenario

WEIGHTS: Final = "weights.npz"

VALIDATION_SEEDS: Final = TRAINING_SEEDS[90_000:90_040]
"""Seeds of the people and lifts of a curve: ten of each behaviour, in no fixed set."""

Weights = Mapping[str, NDArray[Any]]


def checked_network(weights: Weights) -> Network:
    """Return the network of trained weights.

    Raises
    ------
    InputError
        If a weight is not finite, or the shapes do not fit together.
    """
    try:
        return Network(weights)
    except ValueError as error:
        raise InputError(f"trained weights cannot be used: {error}") from error


def write_policy(course: Course, weights: Weights, *, description: str, trained_on: str) -> Path:
    """Write the trained policy into the folder of its course, and return its folder.

    The folder appears complete or not at all. It is the same, byte for byte, for the same weights.

    Parameters
    ----------
    course
        The course of the training.
    weights
        The weights of :class:`.offline.policy.Network`.
    description, trained_on
        Entries of the manifest.

    Raises
    ------
    InputError
        As :func:`checked_network`, or if a file cannot be written.
    """
    checked_network(weights)
    made = course.folder / f".{course.policy.name}.partial"
    shutil.rmtree(made, ignore_errors=True)
    content = BytesIO()
    arrays: dict[str, Any] = {name: np.asarray(weights[name]) for name in sorted(weights)}
    np.savez(content, **arrays)
    about = {
        "name": f"{course.identity['trainer']} seed {course.seed}",
        "description": description,
        "trained_on": trained_on,
    }
    try:
        write_files(made, files(offline).joinpath("policy.py").read_bytes(), about)
        write_whole(made / WEIGHTS, content.getvalue())
        replace_folder(made, course.policy)
    except OSError as error:
        raise InputError(f"cannot write {course.policy}: {error.strerror}") from error
    finally:
        shutil.rmtree(made, ignore_errors=True)
    return course.policy


def engine_error(network: Network, executor: Executor | None = None) -> float:
    """Return the mean RMSE of a network in the lifts of :data:`VALIDATION_SEEDS` [mm].

    Parameters
    ----------
    network
        The network.
    executor
        Plays the lifts; None does so in this process.
    """
    play, seeds = partial(_error, network), VALIDATION_SEEDS
    errors = map(play, seeds) if executor is None else executor.map(play, seeds)
    return float(np.mean(list(errors)))


def _error(network: Network, seed: int) -> float:
    lift = Lift(scenario(seed, BEHAVIOURS, Timing()))
    try:
        return run_episode(lift, Policy(network), seed).scores["rmse_mm"]
    finally:
        lift.close()
