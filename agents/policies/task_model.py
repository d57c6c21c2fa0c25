"""Learning of a task model, combined with adaptive control."""

import math
from dataclasses import dataclass

import numpy as np
from colift.agents.agent import Action, Observation, RobotObservation
from colift.agents.control.adaptive_impedance import Movement, Surprise, certainty, compliance
from colift.agents.control.learned_task import LearnedTask, TaskForecast, load_task
from colift.agents.control.predictor import DEFAULT_PERIOD
from colift.base.errors import InputError
from numpy.typing import NDArray


@dataclass(frozen=True, kw_only=True)
class TaskModelParameters:
    """Parameters of :class:`TaskModel`."""

    model: str | None = None
    """File written by ``colift learn task_model --out``; None: the shipped one."""
    latency: float = 0.1
    """Assumed age of the seen heights [s]."""
    memory: float = 0.5
    """Time constant of the surprise [s]."""
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


class TaskModelController:
    """The control law of :class:`TaskModel` with a given task.

    Parameters
    ----------
    task
        The learned task.
    parameters
        All other parameters; their ``model`` is ignored.

    Attributes
    ----------
    impedance
        The task's impedance; practice replaces it.
    """

    def __init__(self, task: LearnedTask, parameters: TaskModelParameters) -> None:
        self._task, self._parameters = task, parameters
        self.impedance = task.impedance
        self._internals: dict[str, float] = {}

    def reset(self, seed: int) -> None:
        """Begin an episode."""
        self._times: list[float] = []
        self._heights: list[float] = []
        self._forecast: TaskForecast | None = None
        self._surprise = Surprise(self._parameters.memory, self._parameters.limit)

    def act(self, observation: Observation) -> Action:
        """Return the change of the command [m]."""
        return np.array([self.step(observation).change])

    def step(self, observation: Observation) -> Movement:
        """Return the change of the command after the newest observation, and its parts."""
        period = self._add(observation)
        impedance = self.impedance
        forecast = self._forecast = self._task.forecast(self._past_heights())
        now = self._parameters.latency
        goal, variance = forecast.ahead(now + period)
        confidence = certainty(self._surprise.value * variance, self._task.tolerance)
        weights = confidence * forecast.velocities.responsibilities
        stiffness = float(weights @ impedance.stiffness)
        correction = compliance(stiffness)

        begin, _ = forecast.ahead(now + impedance.lead)
        end, _ = forecast.ahead(now + period + impedance.lead)
        velocity = forecast.velocity(now + period + impedance.lead)
        deviation = begin + impedance.offset - float(observation[RobotObservation.HAND_COMMAND])
        self._internals = {
            "prediction": goal,
            "predicted_velocity": velocity,
            "predicted_deviation": math.sqrt(variance),
            "surprise": self._surprise.value,
            "confidence": confidence,
            "stiffness": stiffness,
            "role": 1.0 - correction,
        }
        change = end - begin + correction * deviation
        return Movement(change, deviation, correction, velocity, weights)

    def internals(self) -> dict[str, float]:
        """Return the quantities behind the last action.

        Prediction of the human's end at the end of the period [m], with its velocity [m/s] and
        standard deviation [m]; surprise lambda; confidence, the certainty c; stiffness K; role, the
        fraction of a deviation that the hand leaves uncorrected, K / (1 + K).
        """
        return self._internals

    def _add(self, observation: Observation) -> float:
        """Add the newest sample, and return the time since the last [s]."""
        height = float(observation[RobotObservation.HUMAN_END])
        time = float(observation[RobotObservation.TIME])
        period = DEFAULT_PERIOD
        if self._forecast is not None:
            period = time - self._times[-1]
            expected, variance = self._forecast.ahead(period)
            variance += self._parameters.measurement_noise**2
            self._surprise.update(height - expected, variance, period)
        self._times.append(time)
        self._heights.append(height)
        return period

    def _past_heights(self) -> NDArray[np.float64]:
        """Return the seen heights at whole intervals before the newest, oldest first [m].

        Heights are interpolated between samples; before the first sample, its height is held.
        """
        wanted = self._times[-1] - self._task.interval * np.arange(self._task.past, -1, -1)
        while len(self._times) > 1 and self._times[1] <= wanted[0]:
            del self._times[0], self._heights[0]
        heights: NDArray[np.float64] = np.interp(wanted, self._times, self._heights)
        return heights


class TaskModel(TaskModelController):
    """Plans by a model learned from demonstrations, adapts its impedance (Gribovskaya et al. 2011).

    E. Gribovskaya, A. Kheddar, A. Billard, "Motion learning and adaptive impedance for robot
    control during physical interaction with humans", ICRA 2011: most likely reference 12 of
    Thobbi, Gu and Sheng (2011), by its title and their account of it: "a task-model learning
    approach combined with an adaptive control system. After going through a two-step learning
    process, the robot can work collaboratively with the human while inferring his intent". Its text
    was not available to us. This follows that account and, for the model, the abstract of an
    earlier work of the group, where a Gaussian mixture of demonstrated lifts is reproduced by
    regression (P. Evrard, E. Gribovskaya, S. Calinon, A. Billard, A. Kheddar, "Teaching physical
    collaborative tasks: object-lifting case study with a humanoid", Humanoids 2009). The control
    law is ours.

    **Step one** learns, from demonstrations by two people, a Gaussian mixture of the movements of
    people who lift together. Its regression infers the human's intent: the coming velocities of the
    human's end with their covariance, from the height and the velocities that were seen. They
    extrapolate a sample of age L to the present height of the human's end, p0, and to its height at
    the end of the period T, p1.

    **Step two** learns, by practice with simulated people, the stiffness K_i around that plan in
    each situation i (component of the mixture), and two feed-forward terms for the arm: a time by
    which the command runs ahead of the plan, and an offset (:func:`.adapt`).

    In a lift the hand moves with the plan and corrects a fraction of its deviation d from it:

        change = p1 - p0 + kappa d,    d = p0 + offset - command,
        kappa = 1 / (1 + K),    K = c sum_i h_i K_i,    c = t^2 / (t^2 + lambda s^2),

    with p0 and p1 shifted later by the lead. The h_i are the responsibilities of the components, t
    is the tolerance (height difference of the ends in the demonstrations), s^2 the variance of p1,
    and lambda the surprise at the last samples (:class:`.Surprise`). The robot insists on its plan
    while the model is certain and right, and follows the human otherwise.
    """

    def __init__(self, *, parameters: TaskModelParameters | None = None) -> None:
        parameters = parameters or TaskModelParameters()
        super().__init__(load_task(parameters.model), parameters)
