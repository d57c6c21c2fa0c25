"""The learned task: a mixture of how people lift together, and an impedance for each situation."""

import math
from dataclasses import dataclass, field
from functools import cache, cached_property
from importlib.resources import files
from typing import Any, NamedTuple

import numpy as np
from colift.agents.control.adaptive_impedance import LearnedImpedance
from colift.agents.control.learned import learned_json, load_learned, read_learned
from colift.agents.estimators.gaussian_mixture import (
    Conditional,
    GaussianMixture,
    GaussianMixtureRegression,
)
from colift.base.errors import InputError
from numpy.typing import ArrayLike, NDArray

Array = NDArray[np.float64]


class TaskForecast(NamedTuple):
    """Expected motion of a person from a seen height on."""

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
class LearnedTask:
    """A mixture model of joint lifting with its impedance.

    The mixture is over a height z of the leading end [m] and the mean velocities [m/s] in the
    intervals around it: first the past ones, newest first, then the coming ones, in their order.

    Raises
    ------
    InputError
        If the parts do not fit together, or interval or tolerance is not positive.
    """

    mixture: GaussianMixture
    """Joint density of height, past and coming velocities."""
    past: int
    """Number of past velocities."""
    interval: float
    """Length of an interval [s]."""
    tolerance: float
    """Height difference of the two ends in the demonstrations, rms [m]."""
    impedance: LearnedImpedance
    """One stiffness for each component of the mixture."""
    provenance: dict[str, Any] = field(default_factory=dict)
    """Training data and method."""

    def __post_init__(self) -> None:
        """Check the ranges."""
        most = self.mixture.means.shape[1] - 2
        if not 1 <= self.past <= most:
            raise InputError(
                f"past must be 1 to {most}, to leave a coming velocity, got {self.past}"
            )
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

    def forecast(self, heights: ArrayLike) -> TaskForecast:
        """Return the expected motion after the last of some seen heights.

        Parameters
        ----------
        heights
            (past + 1,) heights [m], an interval apart, oldest first.
        """
        inputs = velocity_inputs(heights, self.interval)
        return TaskForecast(float(inputs[0]), self.regression(inputs), self.interval)


def velocity_inputs(heights: ArrayLike, interval: float) -> Array:
    """Return the inputs of a learned task: the last height, and the velocities, newest first.

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


def task_json(task: LearnedTask) -> str:
    """Return the content of a file for :func:`read_task`."""
    mixture, impedance = task.mixture, task.impedance
    return learned_json(
        {
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
    )


def read_task(text: str) -> LearnedTask:
    """Return the task of :func:`task_json`.

    Raises
    ------
    InputError
        As :func:`.read_learned`.
    """
    return read_learned(text, _from_parts, "a task model")


@cache
def load_task(path: str | None = None) -> LearnedTask:
    """Return the task of a file; without a path, the shipped one.

    Raises
    ------
    InputError
        As :func:`.load_learned`.
    """
    return load_learned(path, files(__package__).joinpath("data", "task_model.json"), read_task)


def _from_parts(parts: Any) -> LearnedTask:
    mixture, impedance = parts["mixture"], parts["impedance"]
    return LearnedTask(
        mixture=GaussianMixture(**{name: np.array(mixture[name]) for name in mixture}),
        past=parts["past"],
        interval=parts["interval_s"],
        tolerance=parts["tolerance_m"],
        impedance=LearnedImpedance(
            stiffness=np.array(impedance["stiffness"]),
            lead=impedance["lead_s"],
            offset=impedance["offset_m"],
        ),
        provenance=parts["provenance"],
    )
