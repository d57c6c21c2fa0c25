"""The adaptive control of a learned task: plans by the model, holds to the plan by an impedance."""

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ..agent import Observation, RobotObservation
from ..errors import InputError
from .adaptive_impedance import Movement, Surprise, certainty, yielding
from .predictor import DEFAULT_PERIOD
from .task import Outlook, Task


@dataclass(frozen=True, kw_only=True)
class TaskModelParameters:
    """Parameters of :class:`.TaskModel`."""

    model: str | None = None
    """File of a model that ``colift learn task_model --out`` wrote; none: the one that is
    shipped."""
    latency: float = 0.1
    """Assumed age of the seen heights [s]."""
    memory: float = 0.5
    """Time in which a surprise is forgotten [s]."""
    limit: float = 25.0
    """Largest normalised squared error that counts as one: five standard deviations."""
    measurement_noise: float = 0.00023
    """Standard deviation of a seen height [m]: a precision of 0.7 mm (section II.A of the paper),
    read as three standard deviations."""

    def __post_init__(self) -> None:
        """Check the ranges.

        Raises
        ------
        InputError
            If the latency is negative, or another number is not positive.
        """
        if not 0 <= self.latency < math.inf:
            raise InputError(f"latency must be a number of at least 0, got {self.latency}")
        for name in ("memory", "limit", "measurement_noise"):
            if not 0 < getattr(self, name) < math.inf:
                raise InputError(f"{name} must be a positive number, got {getattr(self, name)}")


class TaskController:
    """Carries out a learned task; the equations are those of :class:`.TaskModel`.

    Parameters
    ----------
    task
        What was learned.
    parameters
        The rest.

    Attributes
    ----------
    impedance
        The task's; practice replaces it.
    internals
        What the last movement was based on, see :meth:`.TaskModel.internals`.
    """

    def __init__(self, task: Task, parameters: TaskModelParameters) -> None:
        self._task, self._parameters = task, parameters
        self.impedance = task.impedance
        self.internals: dict[str, float] = {}

    def reset(self) -> None:
        """Begin an episode."""
        self._times: list[float] = []
        self._heights: list[float] = []
        self._outlook: Outlook | None = None
        self._surprise = Surprise(self._parameters.memory, self._parameters.limit)

    def step(self, observation: Observation) -> Movement:
        """Return what to do after the newest observation."""
        period = self._see(observation)
        impedance = self.impedance
        outlook = self._outlook = self._task.outlook(self._past_heights())
        now = self._parameters.latency
        goal, variance = outlook.ahead(now + period)
        sure = certainty(self._surprise.value * variance, self._task.tolerance)
        weights = sure * outlook.velocities.responsibilities
        stiffness = float(weights @ impedance.stiffness)
        share = yielding(stiffness)

        begin, _ = outlook.ahead(now + impedance.lead)
        end, _ = outlook.ahead(now + period + impedance.lead)
        velocity = outlook.velocity(now + period + impedance.lead)
        deviation = begin + impedance.offset - float(observation[RobotObservation.HAND_COMMAND])
        self.internals = {
            "prediction": goal,
            "predicted_velocity": velocity,
            "predicted_deviation": math.sqrt(variance),
            "surprise": self._surprise.value,
            "confidence": sure,
            "stiffness": stiffness,
            "role": 1.0 - share,
        }
        return Movement(end - begin + share * deviation, deviation, share, velocity, weights)

    def _see(self, observation: Observation) -> float:
        """Take the newest sample in, and return the time since the last [s]."""
        height = float(observation[RobotObservation.HUMAN_END])
        time = float(observation[RobotObservation.TIME])
        period = DEFAULT_PERIOD
        if self._outlook is not None:
            period = time - self._times[-1]
            expected, variance = self._outlook.ahead(period)
            variance += self._parameters.measurement_noise**2
            self._surprise.update(height - expected, variance, period)
        self._times.append(time)
        self._heights.append(height)
        return period

    def _past_heights(self) -> NDArray[np.float64]:
        """Return the seen heights at whole intervals before the newest, oldest first [m].

        Between two samples the height is interpolated; before the first it is the first.
        """
        wanted = self._times[-1] - self._task.interval * np.arange(self._task.past, -1, -1)
        while len(self._times) > 1 and self._times[1] <= wanted[0]:
            del self._times[0], self._heights[0]
        heights: NDArray[np.float64] = np.interp(wanted, self._times, self._heights)
        return heights
