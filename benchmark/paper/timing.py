"""Errors of control and of prediction for other control periods and latencies (section V.A)."""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Final

import numpy as np
from numpy.typing import NDArray

from ..runner import Run
from .evidence import Timing
from .measures import rms
from .sampled import SampledLift, sampled_lifts
from .table_one import errors

HORIZON: Final = 0.1
"""How far ahead predictions of different control periods are compared [s]: the paper's step."""

MOVING: Final = 0.03
"""Speed [m/s] above which the human moves."""


@dataclass(frozen=True, kw_only=True)
class TimingResult:
    """What came of one setting; predictions only where there are any (NaN elsewhere)."""

    policy: str
    control_period_s: float
    latency_s: float
    rmse_mm: float
    one_step_mm: float
    """Root mean square error of the prediction of the next sample while the human moves [mm]."""
    one_step_ms: float
    """The same as time [ms]: divided by the root mean square speed."""
    ahead_mm: float
    """Root mean square error of a prediction ``HORIZON`` ahead while the human moves [mm]."""


def timing_results(runs: Mapping[Timing, Run]) -> list[TimingResult]:
    """Return the errors of each setting, in the order of the runs."""
    return [_result(timing, run) for timing, run in runs.items()]


def _result(timing: Timing, run: Run) -> TimingResult:
    one_step = one_step_ms = ahead = math.nan
    if timing.policy == "blend":
        lifts = sampled_lifts(run)
        moving = [lift.speed > MOVING for lift in lifts]
        speed = rms(_pooled([lift.speed for lift in lifts], moving))
        one_step = 1000 * rms(_pooled([lift.errors for lift in lifts], moving))
        one_step_ms = one_step / speed
        ahead = 1000 * rms(_pooled([ahead_errors(lift) for lift in lifts], moving))
    return TimingResult(
        policy=timing.policy,
        control_period_s=timing.control_period,
        latency_s=timing.latency,
        rmse_mm=float(errors(run.episodes).mean()),
        one_step_mm=one_step,
        one_step_ms=one_step_ms,
        ahead_mm=ahead,
    )


def _pooled(
    series: Sequence[NDArray[np.float64]], masks: Sequence[NDArray[np.bool_]]
) -> NDArray[np.float64]:
    return np.concatenate([values[mask] for values, mask in zip(series, masks, strict=True)])


def ahead_errors(lift: SampledLift) -> NDArray[np.float64]:
    """Return how wrong the predictions ``HORIZON`` ahead of the sample were [m], shape (m,).

    The filter's prediction one step ahead is carried on at constant acceleration (eq. 5) to the
    horizon. The error stands in the step whose sample it is checked against; NaN before there is
    a prediction for one.
    """
    internals, period = lift.episode.trace.internals, lift.scenario.control_period
    rest = HORIZON - period
    steps = round(HORIZON / period)
    expected = (
        internals["prediction"]
        + internals["predicted_velocity"] * rest
        + internals["predicted_acceleration"] * rest**2 / 2
    )
    missing = np.full(steps, np.nan)
    return lift.samples - np.concatenate((missing, expected[:-steps]))
