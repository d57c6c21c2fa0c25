"""Assistance of a fixed level by an extended Kalman filter of the minimum-jerk model.

After P. Corteville, E. Aertbelien, H. Bruyninckx, J. De Schutter, H. Van Brussel, "Human-inspired
robot assistant for fast point-to-point movements", ICRA 2007. That paper was not at hand: this file
follows the account of Thobbi, Gu and Sheng (2011, section I). By it the filter is designed on the
minimum-jerk model, the amount of assistance is decided beforehand, and the robot knows where the
movement ends; here it does not, and the filter estimates that too. The states of the filter, and
how a new movement is found, are ours.
"""

import math
from dataclasses import dataclass, field

import numpy as np

from ..agent import Action, Observation, RobotObservation
from ..errors import InputError
from ..estimators.minimum_jerk_filter import MinimumJerkFilter, MinimumJerkFilterParameters
from .predictor import DEFAULT_PERIOD


@dataclass(frozen=True, kw_only=True)
class EkfMinimumJerkParameters:
    """Parameters of :class:`EkfMinimumJerk`."""

    assistance: float = 0.9
    """Share of the predicted motion that the robot takes on, in [0, 1]."""
    latency: float = 0.1
    """Assumed age of the seen heights [s]."""
    lag: float = 0.02
    """How far the hand is behind its command [s]: one cycle of the NAO's motion thread."""
    surprise: float = 3.0
    """A sample this many standard deviations from the expected one begins a new movement."""
    motion: MinimumJerkFilterParameters = field(default_factory=MinimumJerkFilterParameters)
    """The filter."""

    def __post_init__(self) -> None:
        """Check the ranges.

        Raises
        ------
        InputError
            If the assistance is not in [0, 1], latency or lag is negative, or the surprise is not
            a positive number.
        """
        if not 0 <= self.assistance <= 1:
            raise InputError(f"assistance must be in [0, 1], got {self.assistance}")
        for name in ("latency", "lag"):
            if not 0 <= getattr(self, name) < math.inf:
                raise InputError(f"{name} must be a number from 0 on, got {getattr(self, name)}")
        if not 0 < self.surprise < math.inf:
            raise InputError(f"surprise must be a positive number, got {self.surprise}")


class EkfMinimumJerk:
    """Takes on a fixed share of a motion it predicts by minimum jerk (Corteville et al. 2007).

    With z_k the seen height, and z(t) the height that the filter expects at the end of the coming
    period, the command becomes

        u = z_k + assistance (z(t) - z_k).
    """

    def __init__(self, *, parameters: EkfMinimumJerkParameters | None = None) -> None:
        self._parameters = parameters or EkfMinimumJerkParameters()
        self._filter = MinimumJerkFilter(self._parameters.motion)

    def reset(self, seed: int) -> None:
        """Begin an episode: nothing was seen yet."""
        self._last: float | None = None

    def act(self, observation: Observation) -> Action:
        """Return the change [m] that brings the command to the assisted height."""
        given, process = self._parameters, self._parameters.motion.process
        height = float(observation[RobotObservation.HUMAN_END])
        time = float(observation[RobotObservation.TIME])
        period = DEFAULT_PERIOD
        surprise = 0.0
        if self._last is None:
            self._filter.reset(height)
        else:
            period = time - self._last
            self._filter.predict(period)
            surprise = self._filter.surprise(height)
            if surprise > given.surprise:
                self._filter.begin()
            self._filter.update(height)
        self._last = time
        state = self._filter.state
        expected = self._filter.ahead(given.latency + period + given.lag)
        self._internals = {
            "prediction": float(expected[0]),
            "predicted_velocity": float(expected[1]),
            "predicted_end": process.goal(state),
            "time_to_go": process.time_to_go(float(state[4]))[0],
            "surprise": surprise,
            "role": given.assistance,
        }
        assisted = height + given.assistance * (float(expected[0]) - height)
        return np.array([assisted - observation[RobotObservation.HAND_COMMAND]])

    def internals(self) -> dict[str, float]:
        """Return what the last action was based on."""
        return self._internals
