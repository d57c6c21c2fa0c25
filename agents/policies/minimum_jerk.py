"""Leading by a minimum-jerk model of the whole stroke.

After Y. Maeda, T. Hara, T. Arai, "Human-robot cooperative manipulation with motion estimation",
IROS 2001. That paper was not available to us: this file follows the account of Thobbi, Gu and
Sheng (2011, section I), in which the parameters of the minimum-jerk model are estimated from the
human's motion, and the robot acts on the velocity profile that they predict. The estimator and the
segmentation into strokes are ours.
"""

import math
from dataclasses import dataclass, field

import numpy as np
from colift.agents.agent import Action, Observation, RobotObservation
from colift.agents.control.predictor import DEFAULT_PERIOD
from colift.agents.estimators.innovation_variance import (
    InnovationVariance,
    InnovationVarianceParameters,
)
from colift.agents.estimators.minimum_jerk_fit import (
    FEWEST,
    MinimumJerkFit,
    MinimumJerkFitParameters,
)
from colift.agents.estimators.stroke_window import StrokeWindow, StrokeWindowParameters
from colift.base.errors import InputError


@dataclass(frozen=True, kw_only=True)
class MinimumJerkParameters:
    """Parameters of :class:`MinimumJerk`."""

    latency: float = 0.1
    """Assumed age of the seen heights [s]."""
    lag: float = 0.02
    """Time by which the hand is behind its command [s]: one cycle of the NAO's motion thread."""
    fit: MinimumJerkFitParameters = field(default_factory=MinimumJerkFitParameters)
    """The fit of a stroke."""
    innovation: InnovationVarianceParameters = field(default_factory=InnovationVarianceParameters)
    """Estimated deviation of the samples from the model."""
    strokes: StrokeWindowParameters = field(default_factory=StrokeWindowParameters)
    """Segmentation into strokes."""

    def __post_init__(self) -> None:
        """Check the ranges.

        Raises
        ------
        InputError
            If latency or lag is negative or not finite.
        """
        for name in ("latency", "lag"):
            if not 0 <= getattr(self, name) < math.inf:
                raise InputError(
                    f"{name} must be a number of at least 0, got {getattr(self, name)}"
                )


class MinimumJerk:
    """Leads by the minimum-jerk stroke that the human's motion so far fits (Maeda et al. 2001).

    A stroke is

        z(t) = start + (end - start) s(tau),  tau = (t - onset) / duration
        s(tau) = 10 tau^3 - 15 tau^4 + 6 tau^5,

    and its four parameters are estimated at every sample from the samples since the last rest or
    turning point (:class:`.MinimumJerkFit`). The command becomes the height that the human is
    expected to reach by the end of the coming period,

        u = E z(t_k + latency + period + lag),

    the mean over all strokes, weighted by their probabilities. While the human rests, u is the mean
    height of the rest.
    """

    def __init__(self, *, parameters: MinimumJerkParameters | None = None) -> None:
        self._parameters = parameters or MinimumJerkParameters()

    def reset(self, seed: int) -> None:
        """Begin an episode without any samples."""
        self._window = StrokeWindow(self._parameters.strokes)
        self._innovation = InnovationVariance(self._parameters.innovation)
        self._time: float | None = None

    def act(self, observation: Observation) -> Action:
        """Return the change [m] that brings the command to the predicted height."""
        height = float(observation[RobotObservation.HUMAN_END])
        time = float(observation[RobotObservation.TIME])
        if self._time is not None and time <= self._time:
            # The clock was set back: earlier samples belong to another time.
            self.reset(0)
        period = DEFAULT_PERIOD if self._time is None else time - self._time
        self._time = time
        self._window.add(time, height)
        self._innovation.compare(time, height, period)
        prediction = self._predict(time, period)
        return np.array([prediction - observation[RobotObservation.HAND_COMMAND]])

    def internals(self) -> dict[str, float]:
        """Return the quantities behind the last action.

        The predicted height and the end of the most likely stroke [m], its duration [s], 0 at rest,
        and the deviation of the samples [m]. The role is 1 for a leader, 0 at rest.
        """
        return self._internals

    def _predict(self, time: float, period: float) -> float:
        """Return the height to command [m]."""
        times, heights = self._window.times, self._window.heights
        deviation = self._innovation.deviation
        if self._window.resting or len(times) < FEWEST:
            prediction = end = float(heights.mean())
            duration = role = 0.0
            self._innovation.remember(time, lambda _: prediction)
        else:
            fit = MinimumJerkFit(times, heights, deviation, self._parameters.fit)
            prediction = fit.height(time + self._parameters.latency + period + self._parameters.lag)
            end, duration, role = fit.stroke.end, fit.stroke.duration, 1.0
            self._innovation.remember(time, fit.height)
        self._internals = {
            "prediction": prediction,
            "predicted_end": end,
            "predicted_duration": duration,
            "spread": deviation,
            "role": role,
        }
        return prediction
