"""The trained policy as a submission: manifest, weights, and a policy in plain NumPy."""

import shutil
from collections.abc import Callable, Mapping
from importlib.resources import files
from io import BytesIO
from pathlib import Path
from types import ModuleType
from typing import Any, Final, TypeVar

import numpy as np
from colift.agents.submissions import network
from colift.agents.submissions.network.policy import Network
from colift.agents.submissions.new import write_files
from colift.base.errors import InputError
from colift.base.places import check_beside, check_empty
from colift.benchmark.training.course import Course, put_in_place, write_whole
from numpy.typing import NDArray

WEIGHTS: Final = "weights.npz"

Weights = Mapping[str, NDArray[Any]]

Made = TypeVar("Made")


def usable(weights: Weights, make: Callable[[Weights], Made]) -> Made:
    """Return the object that ``make`` builds from trained weights.

    Raises
    ------
    InputError
        If a weight is not finite, or the shapes do not fit together.
    """
    try:
        return make(weights)
    except ValueError as error:
        raise InputError(f"trained weights cannot be used: {error}") from error


def checked_network(weights: Weights) -> Network:
    """Return the network of trained weights; see :func:`usable`."""
    return usable(weights, Network)


def write_policy(
    course: Course,
    weights: Weights,
    about: Mapping[str, str],
    *,
    package: ModuleType = network,
    check: Callable[[Weights], object] = checked_network,
) -> Path:
    """Write the trained policy into the folder of its course, and return its folder.

    The folder appears complete or not at all. It is the same, byte for byte, for the same weights.

    Parameters
    ----------
    course
        The course of the training.
    weights
        The weights, in the form that its policy reads.
    about
        Entries of the manifest; the name is that of the trainer and the seed.
    package
        The package of its ``policy.py``.
    check
        Raises an InputError if the policy could not use the weights.

    Raises
    ------
    InputError
        As ``check``, or if a file cannot be written.
    """
    check(weights)
    name = f"{course.identity['trainer']} seed {course.seed}"
    return write_network(course.policy, weights, {"name": name, **about}, package)


def check_place(folder: Path) -> None:
    """Refuse a folder for a trained network, before it is trained; make the folders above it.

    Raises
    ------
    InputError
        If it is not a new or empty folder, or cannot be written.
    """
    if not folder.name:
        raise InputError(f"{folder} cannot be replaced; name a new folder")
    check_empty(folder)
    check_beside(folder)


def write_network(
    folder: Path, weights: Weights, about: Mapping[str, str], package: ModuleType = network
) -> Path:
    """Write a trained network as a submission, and return its folder; see :func:`write_policy`.

    Parameters
    ----------
    folder
        The folder, which is replaced.
    weights
        The weights, in the form that its policy reads.
    about
        Entries of the manifest.
    package
        The package of its ``policy.py``.

    Raises
    ------
    InputError
        If a file cannot be written.
    """
    made = folder.with_name(f".{folder.name}.partial")
    shutil.rmtree(made, ignore_errors=True)
    content = BytesIO()
    arrays: dict[str, Any] = {name: np.asarray(weights[name]) for name in sorted(weights)}
    np.savez(content, **arrays)
    try:
        source = files(package).joinpath("policy.py").read_bytes()
        write_files(made, source, about)
        write_whole(made / WEIGHTS, content.getvalue())
        put_in_place(made, folder)
    except OSError as error:
        raise InputError(f"cannot write {folder}: {error.strerror}") from error
    finally:
        shutil.rmtree(made, ignore_errors=True)
    return folder
