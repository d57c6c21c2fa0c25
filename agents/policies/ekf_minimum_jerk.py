"""Assistance at a fixed level by an extended Kalman filter of the minimum-jerk model.

After P. Corteville, E. Aertbelien, H. Bruyninckx, J. De Schutter, H. Van Brussel, "Human-inspired
robot assistant for fast point-to-point movements", ICRA 2007. That paper was not available to us:
this file follows the account of Thobbi, Gu and Sheng (2011, section I), in which the filter is
based on the minimum-jerk model, the level of assistance is fixed beforehand, and the robot knows
the goal of the movement; here the filter estimates the goal too. The states of the filter and the
detection of a new movement are ours.
"""

import math
from dataclasses import dataclass, field

import numpy as np
from colift.agents.agent import Action, Observation, RobotObservation
from colift.agents.control.predictor import DEFAULT_PERIOD
from colift.agents.estimators.minimum_jerk_filter import (
    MinimumJerkFilter,
    MinimumJerkFilterParameters,
)
from colift.agents.estimators.stroke_window import StrokeWindow, StrokeWindowParameters
from colift.base.errors import InputError


@dataclass(frozen=True, kw_only=True)
class EkfMinimumJerkParameters:
    """Parameters of :class:`EkfMinimumJerk`."""

    assistance: float = 0.9
    """Fraction of the predicted motion beyond the seen height that is commanded, in [0, 1]: 0 goes
    to the seen height, 1 to the predicted one. On ``standard-v1`` with the seeds 50000 to
    50002, which no suite has, 0, 0.5, 0.8, 0.9 and 1 give 21.5, 12.6, 9.4, 9.3 and 9.8 mm."""
    latency: float = 0.1
    """Assumed age of the seen heights [s]."""
    lag: float = 0.02
    """Time by which the hand is behind its command [s]: one cycle of the NAO's motion thread."""
    motion: MinimumJerkFilterParameters = field(default_factory=MinimumJerkFilterParameters)
    """The filter."""
    strokes: StrokeWindowParameters = field(default_factory=StrokeWindowParameters)
    """Detection of rest."""

    def __post_init__(self) -> None:
        """Check the ranges.

        Raises
        ------
        InputError
            If the assistance is not in [0, 1], or latency or lag is negative or not finite.
        """
        if not 0 <= self.assistance <= 1:
            raise InputError(f"assistance must be in [0, 1], got {self.assistance}")
        for name in ("latency", "lag"):
            if not 0 <= getattr(self, name) < math.inf:
                raise InputError(
                    f"{name} must be a number of at least 0, got {getattr(self, name)}"
                )


class EkfMinimumJerk:
    """Assists a minimum-jerk motion that it predicts, at a fixed level (Corteville et al. 2007).

    With z_k the seen height, and z the height that :class:`.MinimumJerkFilter` expects, the command
    becomes

        u = z_k + assistance (z(t_k + latency + period + lag) - z_k).

    While the human rests, the filter is reset before each sample to the start of a movement, up or
    down, with unknown goal and duration. After the rest the filter runs freely.
    """

    def __init__(self, *, parameters: EkfMinimumJerkParameters | None = None) -> None:
        self._parameters = parameters or EkfMinimumJerkParameters()
        self._filter = MinimumJerkFilter(self._parameters.motion)

    def reset(self, seed: int) -> None:
        """Begin an episode without any samples."""
        self._window = StrokeWindow(self._parameters.strokes)
        self._time: float | None = None

    def act(self, observation: Observation) -> Action:
        """Return the change [m] that brings the command to the assisted height."""
        given = self._parameters
        height = float(observation[RobotObservation.HUMAN_END])
        time = float(observation[RobotObservation.TIME])
        if self._time is not None and time <= self._time:
            # The clock was set back: earlier samples belong to another time.
            self.reset(0)
        period = DEFAULT_PERIOD if self._time is None else time - self._time
        self._time = time
        self._window.add(time, height)
        if self._window.resting:
            self._filter.reset(float(self._window.heights.mean()))
        else:
            self._filter.predict(period)
            self._filter.update(height)
        state = self._filter.state
        expected = self._filter.ahead(given.latency + period + given.lag)
        self._internals = {
            "prediction": float(expected[0]),
            "predicted_velocity": float(expected[1]),
            "predicted_end": given.motion.process.goal(state),
            "time_to_go": given.motion.process.time_to_go(float(state[4]))[0],
            "role": given.assistance,
        }
        assisted = height + given.assistance * (float(expected[0]) - height)
        return np.array([assisted - observation[RobotObservation.HAND_COMMAND]])

    def internals(self) -> dict[str, float]:
        """Return the quantities behind the last action.

        The predicted height [m] and velocity [m/s], the end of the movement [m] and the time to go
        until then [s]. The role is the assistance: 1 for a leader and 0 for a follower.
        """
        return self._internals
