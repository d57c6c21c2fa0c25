"""Velocity and acceleration, as the paper has them: derived from the observed position."""

import numpy as np
from numpy.typing import NDArray

from .sampled import SampledLift

Series = NDArray[np.float64]


def derivatives(lift: SampledLift) -> tuple[Series, Series]:
    """Return velocity [m/s] and acceleration [m/s2] of the samples by central differences.

    Both have shape (m,), one value a sample.
    """
    period = lift.scenario.control_period
    velocity = np.gradient(lift.samples, period)
    return velocity, np.gradient(velocity, period)
