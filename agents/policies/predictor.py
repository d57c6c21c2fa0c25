"""One-step prediction of the human's end with its confidence: what proactive policies share."""

from dataclasses import dataclass, field
from typing import get_args

from ..agent import Observation, RobotObservation
from ..errors import InputError
from ..estimators.confidence import LITERAL, Confidence, Reading, likelihood
from ..estimators.motion_filter import MotionFilter, MotionFilterParameters, Prediction

DEFAULT_PERIOD = 0.1
"""Time between two samples before there have been two [s]: the paper's."""


@dataclass(frozen=True, kw_only=True)
class PredictorParameters:
    """Parameters of :class:`Predictor`."""

    motion: MotionFilterParameters = field(default_factory=MotionFilterParameters)
    """The Kalman filter."""
    forgetting: float = 0.45
    """phi of eq. 7."""
    reading: Reading = LITERAL
    """How eq. 6 is read."""

    def __post_init__(self) -> None:
        """Check the reading; the rest is checked where it is used.

        Raises
        ------
        InputError
            If there is no such reading of eq. 6.
        """
        if self.reading not in get_args(Reading):
            known = ", ".join(map(repr, get_args(Reading)))
            raise InputError(f"reading must be one of {known}, got {self.reading!r}")


class Predictor:
    """Predicts the human's height one step ahead of the sample, and says how sure it is.

    Literally the paper's: the sample's age is not compensated. The next step is taken to last as
    long as the one before it. With the first sample there is no prediction to judge yet: it counts
    as one of likelihood 1, so that eq. 7 begins at a confidence of 1 and the robot copies.
    """

    def __init__(self, parameters: PredictorParameters | None = None) -> None:
        self._parameters = parameters or PredictorParameters()

    def reset(self) -> None:
        """Forget the last episode."""
        self._filter: MotionFilter | None = None
        self._confidence = Confidence(self._parameters.forgetting)
        self._time = 0.0

    def step(self, observation: Observation) -> tuple[Prediction, float]:
        """Take the newest sample in.

        Returns
        -------
        tuple
            The prediction of the next sample, and the confidence in it (eq. 7).
        """
        height = float(observation[RobotObservation.HUMAN_END])
        time = float(observation[RobotObservation.TIME])
        if self._filter is None:
            self._filter = MotionFilter(self._parameters.motion)
            self._filter.reset(height)
            confidence = self._confidence.update(1.0)
            period = DEFAULT_PERIOD
        else:
            period = time - self._time
            expected = self._filter.predict(period)
            error = 1000 * (height - expected.height)
            chance = likelihood(error, expected.variance, self._parameters.reading)
            confidence = self._confidence.update(chance)
            self._filter.update(height)
        self._time = time
        return self._filter.ahead(period), confidence
