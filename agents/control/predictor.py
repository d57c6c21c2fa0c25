"""One-step prediction of the human's end with its confidence, shared by proactive policies."""

from dataclasses import dataclass, field
from typing import Literal, get_args

from colift.agents.agent import Observation, RobotObservation
from colift.agents.estimators.confidence import LITERAL, Confidence, Reading, likelihood
from colift.agents.estimators.motion_filter import MotionFilter, MotionFilterParameters, Prediction
from colift.agents.estimators.residuals import ResidualConfidence
from colift.base.errors import InputError

ConfidenceForm = Literal["likelihood", "residuals"]
"""Form of the confidence: the paper's forgetting mean of likelihoods (eqs. 6 and 7), or the
p-value of the latest residuals (:mod:`colift.agents.estimators.residuals`)."""

DEFAULT_PERIOD = 0.1
"""Assumed time between samples until two have arrived [s]: the paper's."""


@dataclass(frozen=True, kw_only=True)
class PredictorParameters:
    """Parameters of :class:`Predictor`."""

    motion: MotionFilterParameters = field(default_factory=MotionFilterParameters)
    """The Kalman filter."""
    confidence: ConfidenceForm = "likelihood"
    """Form of the confidence: likelihoods (eqs. 6 and 7), or statistics of residuals."""
    forgetting: float = 0.45
    """phi of eq. 7, in (0, 1]; for ``likelihood``."""
    reading: Reading = LITERAL
    """Meaning of rho in eq. 6; for ``likelihood``."""
    window: int = 5
    """Number of residuals tested together; for ``residuals``."""

    def __post_init__(self) -> None:
        """Check every value.

        Raises
        ------
        InputError
            If the form or the reading is unknown, or a number is out of range.
        """
        for name, kinds in (("confidence", ConfidenceForm), ("reading", Reading)):
            if getattr(self, name) not in get_args(kinds):
                known = ", ".join(map(repr, get_args(kinds)))
                raise InputError(f"{name} must be one of {known}, got {getattr(self, name)!r}")
        Confidence(self.forgetting)
        ResidualConfidence(self.window)


class Predictor:
    """Predicts the human's height one step ahead of the sample, with a confidence.

    As in the paper, the sample's age is not compensated. The next step is assumed to last as long
    as the last one. The first sample has no prediction to compare with and counts with a likelihood
    of 1: eq. 7 begins at a confidence of 1, and the robot copies. The confidence by residuals
    begins at 1 too.
    """

    def __init__(self, parameters: PredictorParameters | None = None) -> None:
        self._parameters = parameters or PredictorParameters()

    def reset(self) -> None:
        """Forget the last episode."""
        self._filter: MotionFilter | None = None
        self._confidence = Confidence(self._parameters.forgetting)
        self._residuals = ResidualConfidence(self._parameters.window)
        self._time = 0.0
        self._period = DEFAULT_PERIOD

    def step(self, observation: Observation) -> tuple[Prediction, float]:
        """Add the newest sample.

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
        else:
            self._period = time - self._time
            expected = self._filter.predict(self._period)
            confidence = self._compare(1000 * (height - expected.height), expected.variance)
            self._filter.update(height)
        self._time = time
        return self.ahead(self._period), confidence

    @property
    def period(self) -> float:
        """The time between the last two samples [s]; until two have arrived, the paper's."""
        return self._period

    def ahead(self, horizon: float) -> Prediction:
        """Return the prediction ``horizon`` [s] after the newest sample; no state changes.

        Raises
        ------
        ValueError
            Before the first sample.
        """
        if self._filter is None:
            raise ValueError("there is no prediction before the first sample")
        return self._filter.ahead(horizon)

    def _compare(self, error: float, variance: float) -> float:
        """Return the confidence after a prediction error [mm] with the predicted variance [mm2]."""
        parameters = self._parameters
        if parameters.confidence == "residuals":
            return self._residuals.update(error, variance + parameters.motion.measurement_noise)
        return self._confidence.update(likelihood(error, variance, parameters.reading))
