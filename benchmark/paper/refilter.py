"""The predictor run again, offline, over the samples of a recorded lift (section IV.C)."""

from dataclasses import dataclass

import numpy as np
from colift.agents.control.predictor import PredictorParameters
from colift.agents.estimators.confidence import Confidence, likelihood
from colift.agents.estimators.motion_filter import MotionFilter
from numpy.typing import ArrayLike, NDArray

Series = NDArray[np.float64]


@dataclass(frozen=True, kw_only=True, eq=False)
class Refiltered:
    """The prediction of each sample before it was seen; n samples.

    The first sample has no prediction; it counts as its own, at rest.
    """

    height: Series
    """(n,) predicted height [m]."""
    velocity: Series
    """(n,) predicted velocity [m/s]."""
    acceleration: Series
    """(n,) predicted acceleration [m/s2]."""
    deviation: Series
    """(n,) standard deviation of the predicted height [m]."""
    likelihood: Series
    """(n,) likelihood of the sample (eq. 6)."""


def refilter(samples: ArrayLike, period: float, parameters: PredictorParameters) -> Refiltered:
    """Run the Kalman filter over samples and return the prediction of each.

    Parameters
    ----------
    samples
        Measured heights of the human's end [m], shape (n,), n > 0.
    period
        Time between two samples [s].
    parameters
        Filter and reading of eq. 6.
    """
    first, *others = np.asarray(samples, dtype=np.float64).tolist()
    motion = MotionFilter(parameters.motion)
    motion.reset(first)
    rows = [(first, 0.0, 0.0, 0.0, 1.0)]
    for sample in others:
        expected = motion.predict(period)
        chance = likelihood(
            1000 * (sample - expected.height), expected.variance, parameters.reading
        )
        deviation = expected.variance**0.5 / 1000
        rows.append((expected.height, expected.velocity, expected.acceleration, deviation, chance))
        motion.update(sample)
    return Refiltered(
        **dict(
            zip(
                ("height", "velocity", "acceleration", "deviation", "likelihood"),
                np.array(rows).T,
                strict=True,
            )
        )
    )


def confidence_trajectory(likelihoods: ArrayLike, forgetting: float) -> Series:
    """Return the confidence after each likelihood (eq. 7), shape (n,).

    Parameters
    ----------
    likelihoods
        Likelihood of each sample (eq. 6), shape (n,).
    forgetting
        phi, in (0, 1].
    """
    confidence = Confidence(forgetting)
    profile = [confidence.update(value) for value in np.asarray(likelihoods).tolist()]
    return np.array(profile)
