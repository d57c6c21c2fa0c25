"""A learned task: how people lift together, and how stiffly to go along with it."""

import json
import math
from dataclasses import dataclass, field
from functools import cache, cached_property
from importlib.resources import files
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..errors import InputError
from ..estimators.gaussian_mixture import Conditional, GaussianMixture, GaussianMixtureRegression
from .adaptive_impedance import Impedance

Array = NDArray[np.float64]


class Outlook(NamedTuple):
    """What a task model expects of a person's motion from a seen height on."""

    height: float
    """The seen height [m]."""
    velocities: Conditional
    """Velocities in the coming intervals [m/s]."""
    interval: float
    """Length of an interval [s]."""

    def ahead(self, time: float) -> tuple[float, float]:
        """Return height [m] and its variance [m2] a ``time`` [s] after the seen height.

        The velocity is constant within an interval, and after the last one.
        """
        mean, covariance, _ = self.velocities
        begins = self.interval * np.arange(len(mean))
        spent = np.clip(time - begins, 0.0, self.interval)
        spent[-1] = max(time - begins[-1], 0.0)
        return self.height + float(spent @ mean), float(spent @ covariance @ spent)

    def velocity(self, time: float) -> float:
        """Return the velocity a ``time`` [s] after the seen height [m/s]."""
        mean = self.velocities.mean
        return float(mean[min(int(time / self.interval), len(mean) - 1)])


@dataclass(frozen=True, kw_only=True, eq=False)
class Task:
    """A task model, and the impedance that was learned with it.

    The mixture is over a height z of the leading end [m] and the mean velocities [m/s] in the
    intervals around it: first the last ones, newest first, then the coming ones, in their order.

    Raises
    ------
    InputError
        If the parts do not fit together, or interval or tolerance is not positive.
    """

    mixture: GaussianMixture
    """Joint density of height, past and coming velocities."""
    past: int
    """How many of the velocities are past."""
    interval: float
    """Length of an interval [s]."""
    tolerance: float
    """How far apart the two ends were in the demonstrations, rms [m]."""
    impedance: Impedance
    """One situation for each component of the mixture."""
    provenance: dict[str, Any] = field(default_factory=dict)
    """What it was learned from, and how."""

    def __post_init__(self) -> None:
        """Check the ranges."""
        most = self.mixture.means.shape[1] - 2
        if not 1 <= self.past <= most:
            raise InputError(f"past must be 1 to {most}, so that some are coming, got {self.past}")
        for name in ("interval", "tolerance"):
            if not 0 < getattr(self, name) < math.inf:
                raise InputError(f"{name} must be a positive number, got {getattr(self, name)}")
        situations, components = len(self.impedance.stiffness), len(self.mixture.weights)
        if situations != components:
            raise InputError(
                f"a mixture of {components} components needs as many stiffnesses, got {situations}"
            )

    @cached_property
    def regression(self) -> GaussianMixtureRegression:
        """Coming velocities, given height and past ones."""
        return GaussianMixtureRegression(self.mixture, 1 + self.past)

    def outlook(self, heights: ArrayLike) -> Outlook:
        """Return what is expected after the last of some seen heights.

        Parameters
        ----------
        heights
            (past + 1,) heights [m], an interval apart, oldest first.
        """
        inputs = velocity_inputs(heights, self.interval)
        return Outlook(float(inputs[0]), self.regression(inputs), self.interval)


def velocity_inputs(heights: ArrayLike, interval: float) -> Array:
    """Return the inputs of a task model: the last height, and the velocities, newest first.

    Parameters
    ----------
    heights
        (..., n + 1) heights [m], ``interval`` [s] apart, oldest first.

    Returns
    -------
    array
        (..., n + 1).
    """
    heights = np.asarray(heights, dtype=np.float64)
    velocities = np.diff(heights)[..., ::-1] / interval
    return np.concatenate((heights[..., -1:], velocities), axis=-1)


def task_json(task: Task) -> str:
    """Return the content of a file for :func:`read_task`, one part a line."""
    mixture, impedance = task.mixture, task.impedance
    content = {
        "mixture": {
            "weights": mixture.weights.tolist(),
            "means": mixture.means.tolist(),
            "covariances": mixture.covariances.tolist(),
        },
        "past": task.past,
        "interval_s": task.interval,
        "tolerance_m": task.tolerance,
        "impedance": {
            "stiffness": impedance.stiffness.tolist(),
            "lead_s": impedance.lead,
            "offset_m": impedance.offset,
        },
        "provenance": task.provenance,
    }
    lines = (f"{json.dumps(name)}: {json.dumps(value)}" for name, value in content.items())
    return "{\n" + ",\n".join(lines) + "\n}\n"


def read_task(text: str) -> Task:
    """Return the task of :func:`task_json`.

    Raises
    ------
    InputError
        If the text is no such content.
    """
    try:
        content = json.loads(text)
        mixture, impedance = content["mixture"], content["impedance"]
        return Task(
            mixture=GaussianMixture(**{name: np.array(mixture[name]) for name in mixture}),
            past=content["past"],
            interval=content["interval_s"],
            tolerance=content["tolerance_m"],
            impedance=Impedance(
                stiffness=np.array(impedance["stiffness"]),
                lead=impedance["lead_s"],
                offset=impedance["offset_m"],
            ),
            provenance=content["provenance"],
        )
    except InputError:
        raise
    except (ValueError, KeyError, TypeError) as error:
        raise InputError(f"no task model: {type(error).__name__}: {error}") from error


@cache
def load_task(path: str | None = None) -> Task:
    """Return the task model of a file; of none, the one that is shipped.

    Raises
    ------
    InputError
        If the file cannot be read, or is no task model.
    """
    if path is None:
        return read_task(files(__package__).joinpath("data", "task_model.json").read_text())
    try:
        return read_task(Path(path).read_text())
    except (OSError, UnicodeDecodeError) as error:
        raise InputError(f"{path}: cannot be read: {error}") from None
    except InputError as error:
        raise InputError(f"{path}: {error}") from None
